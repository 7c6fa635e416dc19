//! `labels.csv`: one row an object, appended when it is finished and never rewritten.

use std::collections::HashSet;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::record::{COLUMNS, LabelRecord};

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
    /// A row that is not what the columns say.
    #[error("{path}, line {line}: not a row of labels")]
    Row {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
    },
    /// Not a label file, or one of another protocol.
    #[error("{path}: header is {found:?}, must be {expected:?}: labels of another protocol")]
    Header {
        /// The file.
        path: PathBuf,
        /// First line found.
        found: String,
        /// First line expected.
        expected: String,
    },
}

/// What a row is about: object, size and measurement, as text.
type RowKey = [String; 3];

/// An open label file. A row reaches the disk in one write before [`Self::append`]
/// returns, so a killed run loses at most the object it was working on.
pub struct LabelStore {
    file: File,
    path: PathBuf,
    finished: HashSet<RowKey>,
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

        let mut store = Self { file, path: path.to_owned(), finished: HashSet::new() };
        match text.lines().next() {
            None => store.write_row(&COLUMNS)?,
            Some(found) => {
                check_header(path, found)?;
                let mut reader = csv::Reader::from_reader(text.as_bytes());
                store.finished = reader.records().filter_map(|row| row_key(&row.ok()?)).collect();
            }
        }
        Ok(store)
    }

    /// True when this measurement of `object` at this size has its row already.
    pub fn is_finished(&self, object: &str, draw: u64, repeat: u64) -> bool {
        self.finished.contains(&[object.to_owned(), draw.to_string(), repeat.to_string()])
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
        self.write_row(&record.cells())?;
        self.finished.insert([record.object.clone(), record.draw.to_string(), record.repeat.to_string()]);
        Ok(())
    }

    fn write_row<T: AsRef<[u8]>>(&mut self, cells: &[T]) -> Result<(), StoreError> {
        let io = |source: std::io::Error| StoreError::Io { path: self.path.clone(), source };
        let mut line = csv::WriterBuilder::new().from_writer(Vec::new());
        line.write_record(cells).map_err(|e| io(std::io::Error::other(e)))?;
        let bytes = line.into_inner().map_err(|e| io(std::io::Error::other(e.to_string())))?;
        self.file.write_all(&bytes).and_then(|()| self.file.sync_data()).map_err(io)
    }
}

/// The finished rows of a label file; a row cut off by a kill is left out.
///
/// # Errors
/// [`StoreError`] when the file cannot be read, has other columns or a malformed row.
pub fn read_labels(path: &Path) -> Result<Vec<LabelRecord>, StoreError> {
    let text =
        std::fs::read_to_string(path).map_err(|source| StoreError::Io { path: path.to_owned(), source })?;
    let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
    check_header(path, whole.lines().next().unwrap_or_default())?;
    let mut rows = Vec::new();
    for (index, row) in csv::Reader::from_reader(whole.as_bytes()).records().enumerate() {
        let record = row.ok().and_then(|row| LabelRecord::from_cells(&row.iter().collect::<Vec<_>>()));
        rows.push(record.ok_or_else(|| StoreError::Row { path: path.to_owned(), line: index + 2 })?);
    }
    Ok(rows)
}

fn check_header(path: &Path, found: &str) -> Result<(), StoreError> {
    let expected = COLUMNS.join(",");
    if found == expected {
        return Ok(());
    }
    Err(StoreError::Header { path: path.to_owned(), found: found.to_string(), expected })
}

fn row_key(row: &csv::StringRecord) -> Option<RowKey> {
    let column = |name| COLUMNS.iter().position(|&c| c == name).and_then(|at| row.get(at));
    Some([column("object")?.to_owned(), column("draw")?.to_owned(), column("repeat")?.to_owned()])
}

#[cfg(test)]
mod tests {
    use super::super::lognormal::LogNormalCurve;
    use super::super::record::{CurveSample, LabelStatus, Reading};
    use super::*;

    fn record(object: &str) -> LabelRecord {
        LabelRecord {
            object: object.into(),
            name: "Chair, wooden".into(),
            category: "Seats".into(),
            licence: "CC-BY 3.0".into(),
            draw: 0,
            repeat: 0,
            radius_m: 0.1,
            seed: 5,
            reading: Reading {
                status: LabelStatus::Ok,
                v_gain: Some(22),
                v_gain_sigma: 0.75,
                v_star: Some(31),
                v_star_sigma: 1.5,
                v_near: 25,
                v_near_sigma: 1.0,
                curve: LogNormalCurve { y0: 12.0, amplitude: 20.0, x_c: 6.0, width: 0.9 },
                rms_db: 0.2,
            },
            samples: vec![CurveSample { views: 3, psnr_db: vec![25.0, 25.5], both_db: vec![24.0, 24.5] }],
            cpu_s: 40.0,
        }
    }

    #[test]
    fn a_reopened_file_knows_what_is_finished() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        LabelStore::open(&path).unwrap().append(&record("a")).unwrap();
        let mut store = LabelStore::open(&path).unwrap();
        assert!(store.is_finished("a", 0, 0) && !store.is_finished("b", 0, 0));
        store.append(&record("b")).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().count(), 3);
        let columns = COLUMNS.len();
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
        assert!(store.is_finished("a", 0, 0) && !store.is_finished("b", 0, 0));
        store.append(&record("b")).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn sizes_and_repeats_of_an_object_are_rows_of_their_own_and_come_back_as_written() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        let rows = [record("a"), LabelRecord { draw: 1, ..record("a") }, record("b, with a comma")];
        let mut store = LabelStore::open(&path).unwrap();
        for row in &rows {
            store.append(row).unwrap();
        }
        let reopened = LabelStore::open(&path).unwrap();
        assert!(reopened.is_finished("a", 1, 0) && reopened.is_finished("b, with a comma", 0, 0));
        assert!(!reopened.is_finished("a", 0, 1));
        assert_eq!(read_labels(&path).unwrap(), rows);
    }

    #[test]
    fn a_malformed_row_is_named() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        LabelStore::open(&path).unwrap().append(&record("a")).unwrap();
        let broken = std::fs::read_to_string(&path).unwrap().replace("3:25.0000/25.5000", "3;25");
        std::fs::write(&path, broken).unwrap();
        assert!(matches!(read_labels(&path), Err(StoreError::Row { line: 2, .. })));
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
