//! The file of reconstructions: one row an object, size and number of views, appended one at a time.
//!
//! What a number of views leads to does not depend on who asked for it, so other networks' tables reuse the file. It
//! does depend on the object's mesh, the renderer, the view sets and the NeRFs' kernels, which the file does not name:
//! when one of those changes, the file must go.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::files::replace;
use crate::label::record::LabelRecord;
use crate::nerf::NerfSettings;

const COLUMNS: [&str; 8] = ["object", "draw", "radius_m", "nerfs", "views", "psnr_db", "ssim", "movement_m"];

/// NeRFs of each view count, each with its own turn of the view set and seed.
pub const NERFS: usize = 2;

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

impl Reconstruction {
    /// PSNR, SSIM and movement as files have them.
    pub fn cells(&self) -> [String; 3] {
        [format!("{:.4}", self.psnr_db), format!("{:.6}", self.ssim), format!("{:.5}", self.movement_m)]
    }
}

/// An object at one of its sizes, and a number of views of it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    object: String,
    draw: u64,
    /// Metres as the label file writes them: labels made anew at another size are not those of the file.
    radius: String,
    /// NeRFs, steps of each, samples of a step.
    nerfs: String,
    views: u32,
}

impl Key {
    fn new(record: &LabelRecord, nerf: &NerfSettings, views: u32) -> Key {
        let radius = format!("{:.5}", record.radius_m);
        let nerfs = format!("{NERFS}x{}x{}", nerf.steps, nerf.samples_per_step);
        Key { object: record.object.clone(), draw: record.draw, radius, nerfs, views }
    }
}

/// Why reconstructions could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ReconstructionStoreError {
    /// The file system said no.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: std::io::Error,
    },
    /// A figure is infinite or not a number; nothing was written.
    #[error("{object} with {views} views: {made:?} is not finite")]
    NotFinite {
        /// The object's key.
        object: String,
        /// Number of views.
        views: u32,
        /// The figures.
        made: Reconstruction,
    },
    /// Not a file of reconstructions, or another program's rows in it, or two rows that contradict each other.
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
    /// [`ReconstructionStoreError`].
    pub fn open(path: &Path) -> Result<ReconstructionStore, ReconstructionStoreError> {
        let io = |source| ReconstructionStoreError::Io { path: path.to_owned(), source };
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(io(error)),
        };
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let known =
            read(whole).map_err(|what| ReconstructionStoreError::Content { path: path.to_owned(), what })?;
        let header = line(&COLUMNS).map_err(io)?;
        if whole.is_empty() && !header.starts_with(text.as_bytes()) {
            let what = format!("the first line is not {}", COLUMNS.join(","));
            return Err(ReconstructionStoreError::Content { path: path.to_owned(), what });
        }
        // Written again where a line is missing or cut; the file is small.
        if whole.is_empty() || whole.len() < text.len() {
            let kept = if whole.is_empty() { header.as_slice() } else { whole.as_bytes() };
            replace(path, kept).map_err(io)?;
        }
        let file = OpenOptions::new().append(true).open(path).map_err(io)?;
        Ok(ReconstructionStore { file, path: path.to_owned(), known })
    }

    /// The reconstruction of this labelled object by such NeRFs of this many views, if it has been made.
    pub fn get(&self, record: &LabelRecord, nerf: &NerfSettings, views: u32) -> Option<Reconstruction> {
        self.known.get(&Key::new(record, nerf, views)).copied()
    }

    /// Appends a reconstruction, waits until it is on disk, and gives it back with the digits of the file, so that a
    /// run and one that resumes it make the same table.
    ///
    /// # Errors
    /// [`ReconstructionStoreError::Io`], which leaves the file as it was, and [`ReconstructionStoreError::NotFinite`].
    pub fn append(
        &mut self,
        record: &LabelRecord,
        nerf: &NerfSettings,
        views: u32,
        made: Reconstruction,
    ) -> Result<Reconstruction, ReconstructionStoreError> {
        let io = |source| ReconstructionStoreError::Io { path: self.path.clone(), source };
        let key = Key::new(record, nerf, views);
        let cells = cells(&key, &made);
        let Some((_, written)) = parse(&csv::StringRecord::from(cells.to_vec())) else {
            return Err(ReconstructionStoreError::NotFinite { object: key.object, views, made });
        };
        let bytes = line(&cells).map_err(io)?;
        let before = self.file.metadata().map_err(io)?.len();
        if let Err(error) = self.file.write_all(&bytes).and_then(|()| self.file.sync_data()) {
            // Half a line must not stand before another thread's; if this fails too, opening drops or refuses it.
            let _ = self.file.set_len(before);
            return Err(io(error));
        }
        self.known.insert(key, written);
        Ok(written)
    }
}

fn cells(key: &Key, made: &Reconstruction) -> [String; COLUMNS.len()] {
    let [psnr_db, ssim, movement_m] = made.cells();
    let Key { object, draw, radius, nerfs, views } = key.clone();
    [object, draw.to_string(), radius, nerfs, views.to_string(), psnr_db, ssim, movement_m]
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
    let mut known = HashMap::new();
    for (index, line) in lines.enumerate() {
        let line = line.map_err(|error| error.to_string())?;
        let (key, made) = parse(&line).ok_or(format!("line {} is no reconstruction", index + 2))?;
        if known.insert(key, made).is_some_and(|before| before != made) {
            return Err(format!("line {} contradicts an earlier one", index + 2));
        }
    }
    Ok(known)
}

fn parse(line: &csv::StringRecord) -> Option<(Key, Reconstruction)> {
    let number = |at: usize| line.get(at)?.parse::<f64>().ok().filter(|x| x.is_finite());
    number(2)?;
    let key = Key {
        object: line.get(0)?.to_owned(),
        draw: line.get(1)?.parse().ok()?,
        radius: line.get(2)?.to_owned(),
        nerfs: line.get(3)?.to_owned(),
        views: line.get(4)?.parse().ok()?,
    };
    Some((key, Reconstruction { psnr_db: number(5)?, ssim: number(6)?, movement_m: number(7)? }))
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

    fn nerf() -> NerfSettings {
        NerfSettings::label()
    }

    const MADE: Reconstruction = Reconstruction { psnr_db: 33.25, ssim: 0.975, movement_m: 3.5 };

    #[test]
    fn reconstructions_come_back_and_half_a_line_is_dropped() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("reconstructions.csv");
        let mut store = ReconstructionStore::open(&path).unwrap();
        store.append(&named("mug, blue"), &nerf(), 24, MADE).unwrap();
        store.append(&named("lamp"), &nerf(), 24, MADE).unwrap();
        drop(store);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 5]).unwrap();
        let mut store = ReconstructionStore::open(&path).unwrap();
        assert_eq!(store.get(&named("mug, blue"), &nerf(), 24), Some(MADE));
        assert_eq!(store.get(&named("lamp"), &nerf(), 24), None);
        store.append(&named("lamp"), &nerf(), 24, MADE).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn a_resumed_run_knows_the_numbers_of_the_first() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("reconstructions.csv");
        let mut store = ReconstructionStore::open(&path).unwrap();
        let thirds = Reconstruction { psnr_db: 100.0 / 3.0, ..MADE };
        let first = store.append(&label(), &nerf(), 24, thirds).unwrap();
        assert_eq!(store.get(&label(), &nerf(), 24), Some(first));
        assert_eq!(ReconstructionStore::open(&path).unwrap().get(&label(), &nerf(), 24), Some(first));
    }

    #[test]
    fn another_number_of_views_or_another_size_is_another_reconstruction() {
        let dir = tempfile::tempdir().unwrap();
        let mut store = ReconstructionStore::open(&dir.path().join("reconstructions.csv")).unwrap();
        store.append(&label(), &nerf(), 24, MADE).unwrap();
        let larger = LabelRecord { radius_m: label().radius_m + 0.01, ..label() };
        let second = LabelRecord { draw: 1, ..label() };
        for other in [larger, second, named("lamp")] {
            assert_eq!(store.get(&other, &nerf(), 24), None);
        }
        assert_eq!(store.get(&label(), &nerf(), 25), None);
        assert_eq!(store.get(&label(), &NerfSettings { steps: 7, ..nerf() }, 24), None);
        assert_eq!(store.get(&label(), &nerf(), 24), Some(MADE));
    }

    #[test]
    fn what_is_not_finite_is_refused_and_leaves_the_file_readable() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("reconstructions.csv");
        let mut store = ReconstructionStore::open(&path).unwrap();
        for psnr_db in [f64::INFINITY, f64::NAN] {
            let refused = store.append(&label(), &nerf(), 24, Reconstruction { psnr_db, ..MADE });
            assert!(matches!(refused, Err(ReconstructionStoreError::NotFinite { views: 24, .. })));
        }
        assert_eq!(ReconstructionStore::open(&path).unwrap().get(&label(), &nerf(), 24), None);
    }

    #[test]
    fn rows_that_contradict_each_other_are_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("reconstructions.csv");
        let mut store = ReconstructionStore::open(&path).unwrap();
        store.append(&label(), &nerf(), 24, MADE).unwrap();
        store.append(&label(), &nerf(), 24, MADE).unwrap();
        assert!(ReconstructionStore::open(&path).is_ok());
        store.append(&label(), &nerf(), 24, Reconstruction { ssim: 0.5, ..MADE }).unwrap();
        assert!(matches!(ReconstructionStore::open(&path), Err(ReconstructionStoreError::Content { .. })));
    }

    #[test]
    fn another_file_is_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        for text in ["a,b\n1,2\n", "a note without an end of line"] {
            std::fs::write(&path, text).unwrap();
            let refused = ReconstructionStore::open(&path);
            assert!(matches!(refused, Err(ReconstructionStoreError::Content { .. })));
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
    }
}
