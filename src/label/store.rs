//! `labels.csv`: one row an object, appended when it is finished and never rewritten.

use std::collections::HashSet;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::lognormal::LogNormalCurve;
use super::protocol::view_counts;

/// Whether a label can be trusted as the paper's protocol defines it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelStatus {
    /// The curve flattens below the ceiling.
    Ok,
    /// Some view set did better than the ceiling of 100 views: the curve has not converged
    /// to it (the authors drop such objects).
    NotConverged,
    /// One more view still pays at [`super::lognormal::MAX_VIEWS`] views.
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
}

/// One finished object.
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
    /// Radius of the object's sphere, metres.
    pub radius_m: f64,
    /// The object's seed.
    pub seed: u64,
    /// Trust.
    pub status: LabelStatus,
    /// v* at the paper's alpha; `None` with [`LabelStatus::NoPlateau`].
    pub v_star: Option<u32>,
    /// Standard deviation of v*, views.
    pub v_star_sigma: f64,
    /// The fitted curve.
    pub curve: LogNormalCurve,
    /// Root mean square residual of the fit, dB.
    pub rms_db: f64,
    /// Mean PSNR over the test views for each of [`view_counts`], dB.
    pub psnr_db: Vec<f64>,
    /// Thread CPU seconds spent, rendering included.
    pub cpu_s: f64,
}

/// Why labels could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The file system said no.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: std::io::Error,
    },
    /// Not a label file, or one of another protocol.
    #[error("{path}: header is {found:?}, must be {expected:?}; give another --out")]
    Header {
        /// The file.
        path: PathBuf,
        /// First line found.
        found: String,
        /// First line expected.
        expected: String,
    },
}

/// The columns of `labels.csv`, in order.
pub fn header() -> Vec<String> {
    let fixed = [
        "object",
        "name",
        "category",
        "licence",
        "radius_m",
        "seed",
        "status",
        "v_star",
        "v_star_sigma",
        "y0",
        "amplitude",
        "x_c",
        "width",
        "rms_db",
    ];
    let counts = view_counts();
    fixed
        .iter()
        .map(ToString::to_string)
        .chain(counts.iter().map(|v| format!("psnr_{v}")))
        .chain(["cpu_s".to_string()])
        .collect()
}

fn row(record: &LabelRecord) -> Vec<String> {
    let curve = &record.curve;
    [record.object.clone(), record.name.clone(), record.category.clone(), record.licence.clone()]
        .into_iter()
        .chain([format!("{:.5}", record.radius_m), record.seed.to_string(), record.status.word().to_string()])
        .chain([
            record.v_star.map_or_else(String::new, |v| v.to_string()),
            format!("{:.2}", record.v_star_sigma),
        ])
        .chain([curve.y0, curve.amplitude, curve.x_c, curve.width, record.rms_db].map(|x| format!("{x:.5}")))
        .chain(record.psnr_db.iter().map(|x| format!("{x:.4}")))
        .chain([format!("{:.2}", record.cpu_s)])
        .collect()
}

/// An open label file. A row reaches the disk in one write before [`Self::append`]
/// returns, so a killed run loses at most the object it was working on.
pub struct LabelStore {
    file: File,
    path: PathBuf,
    finished: HashSet<String>,
}

impl LabelStore {
    /// Opens `path` for appending, or creates it with its header. What a killed run left
    /// of a half-written last row is cut off; finished rows stay as they are.
    ///
    /// # Errors
    /// [`StoreError`] when the file cannot be used or has other columns.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let io = |source| StoreError::Io { path: path.to_owned(), source };
        let mut file =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path).map_err(io)?;
        let mut text = String::new();
        file.read_to_string(&mut text).map_err(io)?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        file.set_len(whole as u64).map_err(io)?;
        file.seek(SeekFrom::End(0)).map_err(io)?;
        text.truncate(whole);

        let expected = header().join(",");
        let mut store = Self { file, path: path.to_owned(), finished: HashSet::new() };
        match text.lines().next() {
            None => store.write_row(&header())?,
            Some(found) if found == expected => {
                let mut reader = csv::Reader::from_reader(text.as_bytes());
                store.finished =
                    reader.records().filter_map(|r| r.ok()?.get(0).map(ToString::to_string)).collect();
            }
            Some(found) => {
                return Err(StoreError::Header { path: path.to_owned(), found: found.to_string(), expected });
            }
        }
        Ok(store)
    }

    /// True when `object` has its row already.
    pub fn is_finished(&self, object: &str) -> bool {
        self.finished.contains(object)
    }

    /// Number of finished rows.
    pub fn len(&self) -> usize {
        self.finished.len()
    }

    /// True when no row is finished.
    pub fn is_empty(&self) -> bool {
        self.finished.is_empty()
    }

    /// Appends one row and waits until it is on disk.
    ///
    /// # Errors
    /// [`StoreError::Io`].
    pub fn append(&mut self, record: &LabelRecord) -> Result<(), StoreError> {
        self.write_row(&row(record))?;
        self.finished.insert(record.object.clone());
        Ok(())
    }

    fn write_row(&mut self, cells: &[String]) -> Result<(), StoreError> {
        let io = |source: std::io::Error| StoreError::Io { path: self.path.clone(), source };
        let mut line = csv::WriterBuilder::new().from_writer(Vec::new());
        line.write_record(cells).map_err(|e| io(std::io::Error::other(e)))?;
        let bytes = line.into_inner().map_err(|e| io(std::io::Error::other(e.to_string())))?;
        self.file.write_all(&bytes).and_then(|()| self.file.sync_data()).map_err(io)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(object: &str) -> LabelRecord {
        LabelRecord {
            object: object.into(),
            name: "Chair, wooden".into(),
            category: "Seats".into(),
            licence: "CC-BY 3.0".into(),
            radius_m: 0.1,
            seed: 5,
            status: LabelStatus::Ok,
            v_star: Some(31),
            v_star_sigma: 1.5,
            curve: LogNormalCurve { y0: 12.0, amplitude: 20.0, x_c: 6.0, width: 0.9 },
            rms_db: 0.2,
            psnr_db: vec![25.0; view_counts().len()],
            cpu_s: 40.0,
        }
    }

    #[test]
    fn a_reopened_file_knows_what_is_finished() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        LabelStore::open(&path).unwrap().append(&record("a")).unwrap();
        let mut store = LabelStore::open(&path).unwrap();
        assert!(store.is_finished("a") && !store.is_finished("b"));
        store.append(&record("b")).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().count(), 3);
        let columns = header().len();
        for row in csv::Reader::from_reader(text.as_bytes()).records() {
            assert_eq!(row.unwrap().len(), columns);
        }
    }

    #[test]
    fn a_row_cut_by_a_kill_is_dropped_and_the_finished_ones_stay() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        let mut store = LabelStore::open(&path).unwrap();
        store.append(&record("a")).unwrap();
        store.append(&record("b")).unwrap();
        drop(store);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 20]).unwrap();
        let mut store = LabelStore::open(&path).unwrap();
        assert!(store.is_finished("a") && !store.is_finished("b"));
        store.append(&record("b")).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn a_file_with_other_columns_is_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        std::fs::write(&path, "a,b\n1,2\n").unwrap();
        assert!(matches!(LabelStore::open(&path), Err(StoreError::Header { .. })));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "a,b\n1,2\n");
    }
}
