//! Table I as a picture: a group of bars a quantity, each the mean absolute difference with its standard error.

use super::counts::Method;
use super::table_one::{Quantity, TableOne};

const PANEL: f64 = 260.0;
const HEIGHT: f64 = 220.0;
const TOP: f64 = 34.0;
const BASE: f64 = 176.0;

/// SVG of the methods beside each other; the label's own row is zero and left out.
pub fn bars(table: &TableOne) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        3.0 * PANEL
    );
    let rows: Vec<_> = table.rows.iter().filter(|row| row.method != Method::Label).collect();
    let errors = (table.objects.max(1) as f64).sqrt();
    for (k, quantity) in Quantity::ALL.into_iter().enumerate() {
        let left = k as f64 * PANEL + 30.0;
        let most =
            rows.iter().map(|row| row.cells[k].mean + row.cells[k].deviation / errors).fold(0.0, f64::max);
        let height = |value: f64| if most > 0.0 { value / most * (BASE - TOP) } else { 0.0 };
        svg.push_str(&format!(
            "<text x=\"{left}\" y=\"18\" font-weight=\"bold\">{}</text>\n",
            quantity.heading()
        ));
        for (i, row) in rows.iter().enumerate() {
            let (x, cell) = (left + 50.0 * i as f64, &row.cells[k]);
            let (bar, error) = (height(cell.mean), height(cell.deviation / errors));
            let fill = if row.method == Method::PrvNet { "#2f6db5" } else { "#b9c4d0" };
            let (middle, top) = (x + 18.0, BASE - bar);
            svg.push_str(&format!(
                "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"36\" height=\"{bar:.1}\" fill=\"{fill}\"/>\n\
                 <path d=\"M{middle:.1} {:.1}V{:.1}\" stroke=\"#333\"/>\n\
                 <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
                 <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"9\">{:.*}</text>\n",
                top - error,
                top + error,
                BASE + 16.0,
                row.method.name(),
                BASE + 30.0,
                quantity.decimals(),
                cell.mean,
            ));
        }
        svg.push_str(&format!("<path d=\"M{left} {BASE}h200\" stroke=\"#333\"/>\n"));
    }
    svg.push_str("</svg>\n");
    svg
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::table_one::{Cell, Row};

    #[test]
    fn every_method_but_the_label_has_a_bar_in_every_panel() {
        let cell = Cell { mean: 0.5, deviation: 0.2, p_value: None };
        let rows = Method::ALL.map(|method| Row { method, views: (1, 1.0, 1), cells: [cell; 3] }).to_vec();
        let svg = bars(&TableOne { objects: 9, rows });
        assert_eq!(svg.matches("width=\"36\"").count(), 12);
        assert_eq!(
            (svg.matches(">0.500<").count(), svg.matches(">0.50000<").count()),
            (8, 4),
            "SSIM has more digits"
        );
        assert!(svg.contains("PRVNet") && !svg.contains("GT label") && !svg.contains("NaN"));
    }
}
