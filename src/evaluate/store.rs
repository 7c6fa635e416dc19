//! The file of reconstructions: one row an object, size and number of views, appended one at a time.
//!
//! What a number of views leads to does not depend on who asked for it, so other networks' tables reuse the file.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::label::record::LabelRecord;

const COLUMNS: [&str; 7] = ["object", "draw", "radius_m", "views", "psnr_db", "ssim", "movement_m"];

/// What a number of views of an object leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reconstruction {
    /// Mean PSNR over the test views and NeRFs, dB.
    pub psnr_db: f64,
    /// Mean structural similarity over the same.
    pub ssim: f64,
    /// Length of the camera's shortest path through the views, metres.
    pub movement_m: f64,
}

/// An object at one of its sizes, and a number of views of it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    object: String,
    draw: u64,
    /// Metres as the label file writes them: labels made anew at another size are not those of the file.
    radius: String,
    views: u32,
}

impl Key {
    fn new(record: &LabelRecord, views: u32) -> Key {
        let radius = format!("{:.5}", record.radius_m);
        Key { object: record.object.clone(), draw: record.draw, radius, views }
    }
}

/// Why reconstructions could not be read or written.
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
    /// Not a file of reconstructions, or another program's rows in it.
    #[error("{path}: {what}; give another --out")]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

/// An open file of reconstructions. Each reaches the disk in one write, so a killed run loses at most one a thread.
pub struct ReconstructionStore {
    file: File,
    path: PathBuf,
    known: HashMap<Key, Reconstruction>,
}

impl ReconstructionStore {
    /// Opens `path`, or creates it. A last line that a kill cut in half is dropped.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn open(path: &Path) -> Result<ReconstructionStore, StoreError> {
        let io = |source| StoreError::Io { path: path.to_owned(), source };
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(io(error)),
        };
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let known = read(whole).map_err(|what| StoreError::Content { path: path.to_owned(), what })?;
        // Written again where a line is missing or cut; the file is small.
        if whole.is_empty() || whole.len() < text.len() {
            let partial = path.with_extension("part");
            let header = if whole.is_empty() { line(&COLUMNS).map_err(io)? } else { Vec::new() };
            let mut file = File::create(&partial).map_err(io)?;
            let written = file.write_all(&header).and_then(|()| file.write_all(whole.as_bytes()));
            written.and_then(|()| file.sync_all()).map_err(io)?;
            std::fs::rename(&partial, path).map_err(io)?;
        }
        let file = OpenOptions::new().append(true).open(path).map_err(io)?;
        Ok(ReconstructionStore { file, path: path.to_owned(), known })
    }

    /// The reconstruction of this labelled object from this many views, if it has been made.
    pub fn get(&self, record: &LabelRecord, views: u32) -> Option<Reconstruction> {
        self.known.get(&Key::new(record, views)).copied()
    }

    /// Appends a reconstruction, waits until it is on disk, and gives it back with the digits of the file, so that a
    /// run and one that resumes it make the same table.
    ///
    /// # Errors
    /// [`StoreError::Io`].
    pub fn append(
        &mut self,
        record: &LabelRecord,
        views: u32,
        made: Reconstruction,
    ) -> Result<Reconstruction, StoreError> {
        let io = |source| StoreError::Io { path: self.path.clone(), source };
        let key = Key::new(record, views);
        let cells = cells(&key, &made);
        let bytes = line(&cells).map_err(io)?;
        self.file.write_all(&bytes).and_then(|()| self.file.sync_data()).map_err(io)?;
        let written = parse(&csv::StringRecord::from(cells.to_vec())).map_or(made, |(_, written)| written);
        self.known.insert(key, written);
        Ok(written)
    }
}

fn cells(key: &Key, made: &Reconstruction) -> [String; COLUMNS.len()] {
    [
        key.object.clone(),
        key.draw.to_string(),
        key.radius.clone(),
        key.views.to_string(),
        format!("{:.4}", made.psnr_db),
        format!("{:.6}", made.ssim),
        format!("{:.5}", made.movement_m),
    ]
}

fn line(cells: &[impl AsRef<[u8]>]) -> std::io::Result<Vec<u8>> {
    let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
    writer.write_record(cells).map_err(std::io::Error::other)?;
    writer.into_inner().map_err(|error| std::io::Error::other(error.to_string()))
}

fn read(text: &str) -> Result<HashMap<Key, Reconstruction>, String> {
    let mut lines = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes()).into_records();
    let Some(header) = lines.next() else { return Ok(HashMap::new()) };
    let header = header.map_err(|error| error.to_string())?;
    if header.iter().ne(COLUMNS) {
        return Err(format!("the first line is not {}", COLUMNS.join(",")));
    }
    lines
        .enumerate()
        .map(|(index, line)| {
            let line = line.map_err(|error| error.to_string())?;
            parse(&line).ok_or(format!("line {} is no reconstruction", index + 2))
        })
        .collect()
}

fn parse(line: &csv::StringRecord) -> Option<(Key, Reconstruction)> {
    let number = |at: usize| line.get(at)?.parse::<f64>().ok().filter(|x| x.is_finite());
    number(2)?;
    let key = Key {
        object: line.get(0)?.to_owned(),
        draw: line.get(1)?.parse().ok()?,
        radius: line.get(2)?.to_owned(),
        views: line.get(3)?.parse().ok()?,
    };
    Some((key, Reconstruction { psnr_db: number(4)?, ssim: number(5)?, movement_m: number(6)? }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::label::store::read_labels;

    fn label() -> LabelRecord {
        read_labels("models/labels.csv".as_ref()).unwrap().swap_remove(0)
    }

    fn named(object: &str) -> LabelRecord {
        LabelRecord { object: object.to_owned(), ..label() }
    }

    const MADE: Reconstruction = Reconstruction { psnr_db: 33.25, ssim: 0.975, movement_m: 3.5 };

    #[test]
    fn reconstructions_come_back_and_half_a_line_is_dropped() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("reconstructions.csv");
        let mut store = ReconstructionStore::open(&path).unwrap();
        store.append(&named("mug, blue"), 24, MADE).unwrap();
        store.append(&named("lamp"), 24, MADE).unwrap();
        drop(store);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 5]).unwrap();
        let mut store = ReconstructionStore::open(&path).unwrap();
        assert_eq!(store.get(&named("mug, blue"), 24), Some(MADE));
        assert_eq!(store.get(&named("lamp"), 24), None);
        store.append(&named("lamp"), 24, MADE).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn a_resumed_run_knows_the_numbers_of_the_first() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("reconstructions.csv");
        let mut store = ReconstructionStore::open(&path).unwrap();
        let thirds = Reconstruction { psnr_db: 100.0 / 3.0, ..MADE };
        let first = store.append(&label(), 24, thirds).unwrap();
        assert_eq!(store.get(&label(), 24), Some(first));
        assert_eq!(ReconstructionStore::open(&path).unwrap().get(&label(), 24), Some(first));
    }

    #[test]
    fn another_number_of_views_or_another_size_is_another_reconstruction() {
        let dir = tempfile::tempdir().unwrap();
        let mut store = ReconstructionStore::open(&dir.path().join("reconstructions.csv")).unwrap();
        store.append(&label(), 24, MADE).unwrap();
        let larger = LabelRecord { radius_m: label().radius_m + 0.01, ..label() };
        assert_eq!((store.get(&label(), 25), store.get(&larger, 24)), (None, None));
    }

    #[test]
    fn another_file_is_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        std::fs::write(&path, "a,b\n1,2\n").unwrap();
        assert!(matches!(ReconstructionStore::open(&path), Err(StoreError::Content { .. })));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "a,b\n1,2\n");
    }
}
