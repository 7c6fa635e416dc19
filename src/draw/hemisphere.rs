//! The picture: one hemisphere a panel, side by side.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::Panel;
use super::dome::Dome;
use super::svg::{escaped, number, text};
use crate::geometry::azimuth_elevation_from_direction;

/// Width of a panel, and radius and middle of its hemisphere, pixels.
const WIDTH: f64 = 450.0;
const RADIUS: f64 = 166.0;
const MIDDLE: (f64, f64) = (225.0, 252.0);
/// Baseline of the first caption and distance of the lines, pixels.
const CAPTIONS: (f64, f64) = (488.0, 22.0);
/// Elevations of the rings, degrees.
const RINGS_DEG: [f64; 3] = [5.0, 30.0, 60.0];
/// Radius of a view's dot, pixels.
const DOT: f64 = 8.5;

const STYLE: &str = "text{font-family:Helvetica,Arial,sans-serif;fill:#1f2328}\
.title{font-size:15px;font-weight:bold;text-anchor:middle}\
.name,.value,.key{font-size:15px}.name{fill:#57606a}.value{font-weight:bold}.key{font-size:13px}\
.tick{font-size:12px;text-anchor:middle;fill:#57606a}\
.base{font-size:12px;font-weight:bold;text-anchor:middle;fill:#953800}\
.ring,.halo{font-size:11px;text-anchor:middle;fill:#424a53}.halo{stroke:#fff;stroke-width:3px}\
.number{font-size:10px;font-weight:bold;text-anchor:middle;fill:#fff}\
.grid{fill:none;stroke:#8c959f;stroke-width:.8}\
.reached{fill:#c6ecc9;stroke:#c6ecc9;stroke-width:.8}.band{fill:#e6e8eb}\
.way{fill:none;stroke:#4b8fd8;stroke-width:2;stroke-linejoin:round}\
.view{fill:#0a4a9c;stroke:#fff}\
.skipped{fill:none;stroke:#cf222e;stroke-width:2.6;stroke-linecap:round}";

/// Draws `panels` from left to right. Seen from above: the top view in the middle, elevation
/// falling outwards evenly, azimuth from +x (right) towards +y (up), base frame.
///
/// The picture has a white ground, so that it can be read on a dark page; equal panels give equal
/// bytes.
pub fn hemispheres(panels: &[Panel]) -> String {
    let lines = panels.iter().map(|panel| panel.captions.len()).max().unwrap_or(0);
    let width = number(WIDTH * panels.len().max(1) as f64);
    let keys = CAPTIONS.0 + CAPTIONS.1 * lines as f64 + 12.0;
    let height = number(keys + 40.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\">\n<title>{}</title>\n<style>{STYLE}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n",
        escaped(&panels.iter().map(|panel| panel.title.as_str()).collect::<Vec<_>>().join(" | "))
    );
    for (index, panel) in panels.iter().enumerate() {
        out += &draw(panel, WIDTH * index as f64);
    }
    out += &legend(panels, keys);
    out + "</svg>\n"
}

fn draw(panel: &Panel, left: f64) -> String {
    let directions = || panel.planned.iter().chain(panel.skipped.iter().map(|(direction, _)| direction));
    // Views below the horizontal plane need a larger dome; without any it ends at that plane.
    let lowest = directions()
        .map(|direction| azimuth_elevation_from_direction(direction).1)
        .chain(panel.reach.iter().map(|map| map.min_elevation_rad))
        .fold(0.0, f64::min);
    let middle = (left + MIDDLE.0, MIDDLE.1);
    let dome = Dome { middle, scale: RADIUS / (FRAC_PI_2 - lowest) };
    let dots: Vec<(f64, f64)> = directions().map(|direction| dome.place(direction)).collect();

    let mut out = text("title", (middle.0, 30.0), &panel.title);
    if let Some(map) = &panel.reach {
        out += &circle("band", middle, dome.radius(map.min_elevation_rad));
        out += &format!("<path class=\"reached\" d=\"{}\"/>\n", map.path(&dome));
        if map.max_elevation_rad < FRAC_PI_2 - 1e-6 {
            let radius = number(dome.radius(map.max_elevation_rad));
            let (x, y) = (number(middle.0), number(middle.1));
            out += &format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"#fff\"/>\n");
        }
    }
    out += &graticule(&dome, panel.base_azimuth_rad, &dots);
    out += &format!("<path class=\"way\" d=\"{}\"/>\n", dome.great_circles(&panel.planned));
    for (direction, reason) in &panel.skipped {
        let (x, y) = dome.place(direction);
        let (l, r, t, b) = (number(x - 5.0), number(x + 5.0), number(y - 5.0), number(y + 5.0));
        out += &format!(
            "<path class=\"skipped\" d=\"M{l} {t}L{r} {b}M{l} {b}L{r} {t}\"><title>{}</title></path>\n",
            escaped(reason)
        );
    }
    for (index, direction) in panel.planned.iter().enumerate() {
        let (x, y) = dome.place(direction);
        out += &circle("view", (x, y), DOT);
        out += &text("number", (x, y + 3.5), &(index + 1).to_string());
    }
    for (line, (name, value)) in panel.captions.iter().enumerate() {
        let y = CAPTIONS.0 + CAPTIONS.1 * line as f64;
        out += &text("name", (left + 60.0, y), name);
        out += &text("value", (left + 205.0, y), value);
    }
    out
}

/// Rings, ticks and the base's direction.
fn graticule(dome: &Dome, base_azimuth_rad: Option<f64>, dots: &[(f64, f64)]) -> String {
    let mut out = circle("grid", dome.middle, RADIUS);
    for degrees in RINGS_DEG {
        let radius = dome.radius(degrees.to_radians());
        out += &circle("grid", dome.middle, radius);
        // Where the label is farthest from the views.
        let free = |at: (f64, f64)| {
            dots.iter().map(|dot| (dot.0 - at.0).hypot(dot.1 - at.1)).fold(f64::INFINITY, f64::min)
        };
        let places = (0..48).map(|k| dome.polar(TAU * (f64::from(k) + 0.5) / 48.0, radius));
        if let Some((x, y)) = places.max_by(|a, b| free(*a).total_cmp(&free(*b))) {
            // Under the text and not its own outline: not every viewer knows `paint-order`.
            for class in ["halo", "ring"] {
                out += &text(class, (x, y + 4.0), &format!("{degrees}\u{b0}"));
            }
        }
    }
    for degrees in (0..360).step_by(30) {
        let azimuth = f64::from(degrees).to_radians();
        let (a, b) = (dome.polar(azimuth, RADIUS), dome.polar(azimuth, RADIUS + 5.0));
        let [ax, ay, bx, by] = [a.0, a.1, b.0, b.1].map(number);
        out += &format!("<path class=\"grid\" d=\"M{ax} {ay}L{bx} {by}\"/>\n");
        let apart = base_azimuth_rad.map_or(f64::INFINITY, |base| (azimuth - base).cos().acos());
        if apart > 0.25 {
            let axis = match degrees {
                0 => " +x",
                90 => " +y",
                _ => "",
            };
            let (x, y) = dome.polar(azimuth, RADIUS + 21.0);
            out += &text("tick", (x, y + 4.0), &format!("{degrees}\u{b0}{axis}"));
        }
    }
    if let Some(base) = base_azimuth_rad {
        let corners = [
            dome.polar(base, RADIUS + 15.0),
            dome.polar(base - 0.04, RADIUS + 3.0),
            dome.polar(base + 0.04, RADIUS + 3.0),
        ]
        .map(|(x, y)| format!("{} {}", number(x), number(y)));
        out += &format!("<path fill=\"#953800\" d=\"M{}Z\"/>\n", corners.join("L"));
        let (x, y) = dome.polar(base, RADIUS + 34.0);
        out += &text("base", (x, y - 2.0), "robot");
        out += &text("base", (x, y + 11.0), "base");
    }
    out
}

/// What the marks mean, one line below all panels.
fn legend(panels: &[Panel], y: f64) -> String {
    let mut out = String::new();
    let mut x = 60.0;
    let mut key = |sign: &str, words: &str, width: f64| {
        out += &format!("<g transform=\"translate({} {})\">{sign}</g>\n", number(x), number(y));
        out += &text("key", (x + 14.0, y + 4.5), words);
        x += width;
    };
    key("<circle class=\"view\" r=\"6\"/>", "view, numbered in order", 200.0);
    if panels.iter().any(|panel| !panel.skipped.is_empty()) {
        key("<path class=\"skipped\" d=\"M-5 -5L5 5M-5 5L5 -5\"/>", "skipped view", 120.0);
    }
    if panels.iter().any(|panel| panel.reach.is_some()) {
        key("<rect class=\"reached\" x=\"-6\" y=\"-6\" width=\"12\" height=\"12\"/>", "in reach", 90.0);
        key("<rect class=\"band\" x=\"-6\" y=\"-6\" width=\"12\" height=\"12\"/>", "out of reach", 110.0);
    }
    out
}

fn circle(class: &str, (x, y): (f64, f64), radius: f64) -> String {
    let (x, y, radius) = (number(x), number(y), number(radius));
    format!("<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>\n")
}
