//! One finished object, and the row it is in `labels.csv`.

use super::fit::CurvePoint;
use super::lognormal::LogNormalCurve;

/// Whether a label can be trusted as the paper's protocol defines it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelStatus {
    /// The curve flattens, and no smaller view set does better than the ceiling by more than noise.
    Ok,
    /// Some smaller view set did better than the ceiling of 100 views by more than the noise
    /// of the two (the authors drop objects with any better set).
    NotConverged,
    /// One more view still pays at [`super::lognormal::MAX_VIEWS`] views, on the steady curve.
    NoPlateau,
}

impl LabelStatus {
    /// The word in the file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::NotConverged => "not_converged",
            Self::NoPlateau => "no_plateau",
        }
    }

    /// The status of a word in the file.
    pub fn from_word(word: &str) -> Option<Self> {
        [Self::Ok, Self::NotConverged, Self::NoPlateau].into_iter().find(|status| status.word() == word)
    }
}

/// All NeRFs of one number of views.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveSample {
    /// Training views.
    pub views: usize,
    /// Mean PSNR over the test views of each NeRF, dB, over black as in the paper.
    pub psnr_db: Vec<f64>,
    /// The same with the squared errors over black and over white averaged, both backgrounds together.
    pub both_db: Vec<f64>,
}

/// What a curve says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Trust.
    pub status: LabelStatus,
    /// The label: the first number of views from which one more brings too little on the steady curve.
    pub v_gain: Option<u32>,
    /// Its standard deviation, views.
    pub v_gain_sigma: f64,
    /// The paper's v*, from its own fit: from here on one more view brings less than alpha.
    pub v_star: Option<u32>,
    /// Standard deviation of v*, views.
    pub v_star_sigma: f64,
    /// Fewest views that come near the object's own ceiling, on the steady curve.
    pub v_near: u32,
    /// Its standard deviation, views.
    pub v_near_sigma: f64,
    /// The steady curve.
    pub curve: LogNormalCurve,
    /// Root mean square residual of the fit, dB.
    pub rms_db: f64,
}

/// One finished object at one size.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelRecord {
    /// The object's key, unique among all objects.
    pub object: String,
    /// Name for people.
    pub name: String,
    /// Category for people.
    pub category: String,
    /// Licence of the model.
    pub licence: String,
    /// Which of the object's sizes.
    pub draw: u64,
    /// Which measurement of this object at this size.
    pub repeat: u64,
    /// Radius of the object's sphere, metres.
    pub radius_m: f64,
    /// Seed of the object at this size.
    pub seed: u64,
    /// What the samples say.
    pub reading: Reading,
    /// Every NeRF.
    pub samples: Vec<CurveSample>,
    /// Thread CPU seconds spent, rendering included.
    pub cpu_s: f64,
}

/// The columns of `labels.csv`, in order.
pub const COLUMNS: [&str; 23] = [
    "object",
    "name",
    "category",
    "licence",
    "draw",
    "repeat",
    "radius_m",
    "seed",
    "status",
    "v_gain",
    "v_gain_sigma",
    "v_star",
    "v_star_sigma",
    "v_near",
    "v_near_sigma",
    "y0",
    "amplitude",
    "x_c",
    "width",
    "rms_db",
    "psnr_db",
    "psnr_both_db",
    "cpu_s",
];

impl LabelRecord {
    /// The cells of [`COLUMNS`].
    pub fn cells(&self) -> Vec<String> {
        let Reading {
            status,
            v_gain,
            v_gain_sigma,
            v_star,
            v_star_sigma,
            v_near,
            v_near_sigma,
            curve,
            rms_db,
        } = &self.reading;
        let open_end = |views: &Option<u32>| views.map_or_else(String::new, |v| v.to_string());
        let text = [&self.object, &self.name, &self.category, &self.licence];
        let numbers = [curve.y0, curve.amplitude, curve.x_c, curve.width, *rms_db];
        text.into_iter()
            .cloned()
            .chain([self.draw.to_string(), self.repeat.to_string()])
            .chain([format!("{:.5}", self.radius_m), self.seed.to_string(), status.word().to_owned()])
            .chain([open_end(v_gain), format!("{v_gain_sigma:.2}")])
            .chain([open_end(v_star), format!("{v_star_sigma:.2}")])
            .chain([v_near.to_string(), format!("{v_near_sigma:.2}")])
            .chain(numbers.map(|x| format!("{x:.5}")))
            .chain([samples_text(&self.samples, over_black), samples_text(&self.samples, over_both)])
            .chain([format!("{:.2}", self.cpu_s)])
            .collect()
    }

    /// The record of a row's cells; `None` where they are not those of [`COLUMNS`].
    pub fn from_cells(cells: &[&str]) -> Option<LabelRecord> {
        let cells: &[&str; COLUMNS.len()] = cells.try_into().ok()?;
        let [object, name, category, licence, draw, repeat, radius_m, seed, status, ..] =
            cells.map(str::to_owned);
        let [
            ..,
            v_gain,
            v_gain_sigma,
            v_star,
            v_star_sigma,
            v_near,
            v_near_sigma,
            y0,
            amplitude,
            x_c,
            width,
            rms_db,
            psnr_db,
            psnr_both_db,
            cpu_s,
        ] = *cells;
        let number = |text: &str| text.parse::<f64>().ok();
        let open_end =
            |text: &str| if text.is_empty() { Some(None) } else { text.parse::<u32>().ok().map(Some) };
        let curve = LogNormalCurve {
            y0: number(y0)?,
            amplitude: number(amplitude)?,
            x_c: number(x_c)?,
            width: number(width)?,
        };
        let reading = Reading {
            status: LabelStatus::from_word(&status)?,
            v_gain: open_end(v_gain)?,
            v_gain_sigma: number(v_gain_sigma)?,
            v_star: open_end(v_star)?,
            v_star_sigma: number(v_star_sigma)?,
            v_near: v_near.parse().ok()?,
            v_near_sigma: number(v_near_sigma)?,
            curve,
            rms_db: number(rms_db)?,
        };
        Some(LabelRecord {
            object,
            name,
            category,
            licence,
            draw: draw.parse().ok()?,
            repeat: repeat.parse().ok()?,
            radius_m: number(&radius_m)?,
            seed: seed.parse().ok()?,
            reading,
            samples: samples_from_text(psnr_db, psnr_both_db)?,
            cpu_s: number(cpu_s)?,
        })
    }
}

/// The PSNR over black of each NeRF of a sample, dB.
pub fn over_black(sample: &CurveSample) -> &[f64] {
    &sample.psnr_db
}

/// The PSNR of each NeRF of a sample over black and white together, dB.
pub fn over_both(sample: &CurveSample) -> &[f64] {
    &sample.both_db
}

/// A PSNR (dB) as the file has it, with four decimals. Labels are read off these, so that reading them again off the
/// file gives the same.
pub fn as_written(psnr_db: f64) -> f64 {
    (psnr_db * 1e4).round() / 1e4
}

/// `3:25.9381/25.8012 5:31.9380/31.8755 ...`: views, then the PSNR of each NeRF.
pub fn samples_text(samples: &[CurveSample], judged: fn(&CurveSample) -> &[f64]) -> String {
    let sample = |s: &CurveSample| {
        let each: Vec<String> = judged(s).iter().map(|x| format!("{x:.4}")).collect();
        format!("{}:{}", s.views, each.join("/"))
    };
    samples.iter().map(sample).collect::<Vec<_>>().join(" ")
}

/// Reads what [`samples_text`] writes over black and over both; `None` where a number is missing
/// or malformed, or the two do not belong to the same NeRFs.
pub fn samples_from_text(black: &str, both: &str) -> Option<Vec<CurveSample>> {
    let sample = |word: &str| {
        let (views, each) = word.split_once(':')?;
        let each = each.split('/').map(|x| x.parse().ok()).collect::<Option<Vec<f64>>>()?;
        Some((views.parse::<usize>().ok()?, each))
    };
    let (black, both) = (black.split_whitespace(), both.split_whitespace());
    if black.clone().count() != both.clone().count() {
        return None;
    }
    let joined = |(black, both): (&str, &str)| {
        let ((views, psnr_db), (same_views, both_db)) = (sample(black)?, sample(both)?);
        let same = views == same_views && psnr_db.len() == both_db.len();
        same.then_some(CurveSample { views, psnr_db, both_db })
    };
    black.zip(both).map(joined).collect()
}

/// The points a curve is fitted to: one a NeRF.
pub fn curve_points(samples: &[CurveSample], judged: fn(&CurveSample) -> &[f64]) -> Vec<CurvePoint> {
    samples.iter().flat_map(|s| judged(s).iter().map(|&psnr| (s.views as f64, psnr))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_psnr_as_written_is_what_comes_back_from_the_file() {
        for k in 0..2000 {
            let written = as_written(20.0 + f64::from(k) * 0.012_345_678_9);
            let sample = CurveSample { views: 5, psnr_db: vec![written], both_db: vec![written] };
            let text = samples_text(std::slice::from_ref(&sample), over_black);
            assert_eq!(samples_from_text(&text, &text), Some(vec![sample]));
        }
    }

    #[test]
    fn samples_survive_their_text() {
        let samples = vec![
            CurveSample { views: 3, psnr_db: vec![25.9381, 26.0], both_db: vec![24.5, 24.25] },
            CurveSample { views: 100, psnr_db: vec![38.5], both_db: vec![37.0] },
        ];
        let (black, both) = (samples_text(&samples, over_black), samples_text(&samples, over_both));
        assert_eq!(black, "3:25.9381/26.0000 100:38.5000");
        assert_eq!(both, "3:24.5000/24.2500 100:37.0000");
        assert_eq!(samples_from_text(&black, &both), Some(samples));
        assert_eq!(samples_from_text("3:25.9 5;31", "3:25.9 5:31"), None);
        assert_eq!(samples_from_text("3:25.9 5:31", "3:25.9/25 5:31"), None);
        assert_eq!(samples_from_text("3:25.9 5:31", "3:25.9 7:31"), None);
        assert_eq!(samples_from_text("3:25.9 5:31", "3:25.9"), None);
    }
}
