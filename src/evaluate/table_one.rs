//! The paper's Table I from trials: how far each method's result is from that of the label's own count.

use super::counts::Method;
use super::store::Reconstruction;
use super::student::paired_p_value;
use super::trial::Trial;

/// p-value below which a difference counts as significant (the paper's).
const SIGNIFICANT: f64 = 0.05;

/// One of the table's columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Absolute difference of PSNR, dB.
    Psnr,
    /// Absolute difference of structural similarity.
    Ssim,
    /// Absolute difference of path length, metres.
    Movement,
}

impl Quantity {
    /// The table's columns, left to right.
    pub const ALL: [Quantity; 3] = [Quantity::Psnr, Quantity::Ssim, Quantity::Movement];

    /// Heading with unit.
    pub fn heading(self) -> &'static str {
        match self {
            Quantity::Psnr => "PSNR difference, dB",
            Quantity::Ssim => "SSIM difference",
            Quantity::Movement => "Movement difference, m",
        }
    }

    /// Decimals that a difference of it is written with.
    pub(super) fn decimals(self) -> usize {
        match self {
            Quantity::Psnr | Quantity::Movement => 3,
            Quantity::Ssim => 5,
        }
    }

    fn of(self, reconstruction: &Reconstruction) -> f64 {
        match self {
            Quantity::Psnr => reconstruction.psnr_db,
            Quantity::Ssim => reconstruction.ssim,
            Quantity::Movement => reconstruction.movement_m,
        }
    }
}

/// A method's figure in one column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Mean absolute difference from the label's count.
    pub mean: f64,
    /// Its standard deviation over objects.
    pub deviation: f64,
    /// PRVNet against this method, two-sided; `None` for PRVNet itself and where all differences agree.
    pub p_value: Option<f64>,
}

/// A method's row.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The method.
    pub method: Method,
    /// Least, mean and most views it gave.
    pub views: (u32, f64, u32),
    /// One cell a [`Quantity::ALL`].
    pub cells: [Cell; 3],
}

/// The table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableOne {
    /// Objects in it.
    pub objects: usize,
    /// Rows in the order of [`Method::ALL`].
    pub rows: Vec<Row>,
}

impl TableOne {
    /// Of trials that are all whole.
    pub fn of(trials: &[Trial]) -> TableOne {
        let differences = |method: Method, quantity: Quantity| -> Vec<f64> {
            let of = |trial: &Trial, method| {
                trial.outcomes.iter().find(|o| o.method == method).map(|o| quantity.of(&o.reconstruction))
            };
            trials.iter().filter_map(|t| Some((of(t, method)? - of(t, Method::Label)?).abs())).collect()
        };
        let row = |method: Method| {
            let views: Vec<u32> = trials
                .iter()
                .flat_map(|t| &t.outcomes)
                .filter(|o| o.method == method)
                .map(|o| o.views)
                .collect();
            let sum: f64 = views.iter().map(|&v| f64::from(v)).sum();
            let least = views.iter().copied().min().unwrap_or(0);
            let most = views.iter().copied().max().unwrap_or(0);
            let cells = Quantity::ALL.map(|quantity| {
                let own = differences(method, quantity);
                let compared = !matches!(method, Method::Label | Method::PrvNet);
                let p_value =
                    compared.then(|| paired_p_value(&differences(Method::PrvNet, quantity), &own)).flatten();
                let (mean, deviation) = mean_and_deviation(&own);
                Cell { mean, deviation, p_value }
            });
            Row { method, views: (least, sum / views.len().max(1) as f64, most), cells }
        };
        TableOne { objects: trials.len(), rows: Method::ALL.map(row).to_vec() }
    }

    /// As Markdown; a star marks where PRVNet is better with p < 0.05.
    pub fn markdown(&self) -> String {
        let headings = Quantity::ALL.map(Quantity::heading).join(" | ");
        let mut text = format!(
            "{} held-out objects.\n\n| method | views | {headings} |\n|---|---|---|---|---|\n",
            self.objects
        );
        let prvnet = self.rows.iter().find(|row| row.method == Method::PrvNet);
        for row in &self.rows {
            let (least, mean, most) = row.views;
            let views =
                if least == most { least.to_string() } else { format!("{least} to {most}, mean {mean:.1}") };
            let cells: Vec<String> = row
                .cells
                .iter()
                .enumerate()
                .map(|(k, cell)| {
                    let better = prvnet.is_some_and(|p| p.cells[k].mean < cell.mean);
                    let star = better && cell.p_value.is_some_and(|p| p < SIGNIFICANT);
                    let p = cell.p_value.map_or_else(String::new, |p| format!(" ({})", p_text(p)));
                    let d = Quantity::ALL[k].decimals();
                    format!("{:.d$} ± {:.d$}{}{p}", cell.mean, cell.deviation, if star { "*" } else { "" })
                })
                .collect();
            text.push_str(&format!("| {} | {views} | {} |\n", row.method.name(), cells.join(" | ")));
        }
        text.push_str(
            "\nDifferences are absolute, from the result with the label's own number of views: mean ± standard\n\
             deviation over objects. p: paired t-test of PRVNet against the method; * where PRVNet is better, p < 0.05.\n",
        );
        text
    }
}

fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let n = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    (mean, (squares / (n - 1.0).max(1.0)).sqrt())
}

/// No p-value is zero.
fn p_text(p: f64) -> String {
    if p < 0.0005 { "p < 0.001".to_owned() } else { format!("p {p:.3}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::trial::Outcome;

    /// Labels of 20 + 2 i views; the network is off by one view, the statistics say 30.
    fn trials() -> Vec<Trial> {
        let outcome = |method, views: u32| {
            let v = f64::from(views);
            let reconstruction =
                Reconstruction { psnr_db: 30.0 + 0.05 * v, ssim: 0.9 + 0.001 * v, movement_m: 0.1 * v };
            Outcome { method, views, reconstruction }
        };
        (0..12)
            .map(|i| {
                let label = 20 + 2 * i;
                let counts = [label, 30, 30, 30, label + 1];
                let outcomes = Method::ALL.into_iter().zip(counts).map(|(m, v)| outcome(m, v)).collect();
                Trial { object: format!("object {i}"), draw: 0, outcomes }
            })
            .collect()
    }

    #[test]
    fn a_network_that_is_nearly_right_beats_constants_significantly() {
        let table = TableOne::of(&trials());
        let row = |method| table.rows.iter().find(|row| row.method == method).unwrap();
        assert_eq!(row(Method::Label).cells[0].mean, 0.0);
        assert!((row(Method::PrvNet).cells[2].mean - 0.1).abs() < 1e-9);
        assert!((row(Method::Mean).cells[2].mean - 0.6).abs() < 1e-9);
        assert!(row(Method::Mean).cells.iter().all(|cell| cell.p_value.unwrap() < 0.05));
        assert_eq!(row(Method::PrvNet).views, (21, 32.0, 43));
        let text = table.markdown();
        assert!(text.contains("| Mode | 30 | 0.300 ± "), "{text}");
        assert!(text.contains("* (p 0.0"), "{text}");
        assert_eq!([0.0, 0.0004, 0.0006, 0.2].map(p_text), ["p < 0.001", "p < 0.001", "p 0.001", "p 0.200"]);
    }
}
