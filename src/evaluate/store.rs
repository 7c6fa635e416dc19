//! The file of trials: one row a method and object, appended an object at a time.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::counts::Method;
use super::trial::{Outcome, Trial};

const COLUMNS: [&str; 7] = ["object", "draw", "method", "views", "psnr_db", "ssim", "movement_m"];

/// Why trials could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum TrialStoreError {
    /// The file system said no.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: std::io::Error,
    },
    /// Not a file of trials, or another program's rows in it.
    #[error("{path}: {what}; give another --out")]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

/// An open file of trials. A trial reaches the disk in one write, so a killed run loses at most one.
pub struct TrialStore {
    file: File,
    path: PathBuf,
    trials: Vec<Trial>,
}

impl TrialStore {
    /// Opens `path`, or creates it. Of a trial that a kill cut in half nothing is kept.
    ///
    /// # Errors
    /// [`TrialStoreError`].
    pub fn open(path: &Path) -> Result<TrialStore, TrialStoreError> {
        let io = |source| TrialStoreError::Io { path: path.to_owned(), source };
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(io(error)),
        };
        let trials = read(&text).map_err(|what| TrialStoreError::Content { path: path.to_owned(), what })?;
        // Written again whole: the file is small, and half a trial is gone that way.
        let partial = path.with_extension("part");
        let mut file = File::create(&partial).map_err(io)?;
        let mut bytes = rows(&[COLUMNS.map(str::to_owned).to_vec()]).map_err(io)?;
        for trial in &trials {
            bytes.extend(rows(&cells(trial)).map_err(io)?);
        }
        file.write_all(&bytes).and_then(|()| file.sync_all()).map_err(io)?;
        std::fs::rename(&partial, path).map_err(io)?;
        let file = OpenOptions::new().append(true).open(path).map_err(io)?;
        Ok(TrialStore { file, path: path.to_owned(), trials })
    }

    /// The finished trials.
    pub fn trials(&self) -> &[Trial] {
        &self.trials
    }

    /// True when this object at this size is finished.
    pub fn is_finished(&self, object: &str, draw: u64) -> bool {
        self.trials.iter().any(|trial| trial.object == object && trial.draw == draw)
    }

    /// Appends a trial and waits until it is on disk.
    ///
    /// # Errors
    /// [`TrialStoreError::Io`].
    pub fn append(&mut self, trial: Trial) -> Result<(), TrialStoreError> {
        let io = |source| TrialStoreError::Io { path: self.path.clone(), source };
        let cells = cells(&trial);
        let bytes = rows(&cells).map_err(io)?;
        self.file.write_all(&bytes).and_then(|()| self.file.sync_data()).map_err(io)?;
        // With the digits of the file, so that a run and one that resumes it make the same table.
        let written = cells.into_iter().filter_map(|row| parse(&csv::StringRecord::from(row)));
        let outcomes = written.map(|(_, _, outcome)| outcome).collect();
        self.trials.push(Trial { outcomes, ..trial });
        Ok(())
    }
}

fn cells(trial: &Trial) -> Vec<Vec<String>> {
    let row = |o: &Outcome| {
        let text =
            [trial.object.clone(), trial.draw.to_string(), o.method.word().to_owned(), o.views.to_string()];
        let numbers = [format!("{:.4}", o.psnr_db), format!("{:.6}", o.ssim), format!("{:.5}", o.movement_m)];
        text.into_iter().chain(numbers).collect()
    };
    trial.outcomes.iter().map(row).collect()
}

fn rows(cells: &[Vec<String>]) -> std::io::Result<Vec<u8>> {
    let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
    for row in cells {
        writer.write_record(row).map_err(std::io::Error::other)?;
    }
    writer.into_inner().map_err(|error| std::io::Error::other(error.to_string()))
}

/// Whole trials only: five rows of one object, one a method.
fn read(text: &str) -> Result<Vec<Trial>, String> {
    let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
    let mut lines = csv::ReaderBuilder::new().has_headers(false).from_reader(whole.as_bytes()).into_records();
    let Some(header) = lines.next() else { return Ok(Vec::new()) };
    let header = header.map_err(|error| error.to_string())?;
    if header.iter().ne(COLUMNS) {
        return Err(format!("the first line is not {}", COLUMNS.join(",")));
    }
    let mut trials: Vec<Trial> = Vec::new();
    for (index, line) in lines.enumerate() {
        let line = line.map_err(|error| error.to_string())?;
        let (object, draw, outcome) = parse(&line).ok_or(format!("line {} is no trial", index + 2))?;
        match trials.last_mut().filter(|t| t.object == object && t.draw == draw) {
            Some(trial) => trial.outcomes.push(outcome),
            None => trials.push(Trial { object, draw, outcomes: vec![outcome] }),
        }
    }
    trials.retain(|trial| trial.outcomes.iter().map(|o| o.method).eq(Method::ALL));
    Ok(trials)
}

fn parse(line: &csv::StringRecord) -> Option<(String, u64, Outcome)> {
    let number = |at: usize| line.get(at)?.parse::<f64>().ok().filter(|x| x.is_finite());
    let outcome = Outcome {
        method: Method::from_word(line.get(2)?)?,
        views: line.get(3)?.parse().ok()?,
        psnr_db: number(4)?,
        ssim: number(5)?,
        movement_m: number(6)?,
    };
    Some((line.get(0)?.to_owned(), line.get(1)?.parse().ok()?, outcome))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(object: &str) -> Trial {
        let outcome = |method| Outcome { method, views: 30, psnr_db: 33.25, ssim: 0.975, movement_m: 3.5 };
        Trial { object: object.to_owned(), draw: 0, outcomes: Method::ALL.map(outcome).to_vec() }
    }

    #[test]
    fn trials_come_back_and_half_a_trial_is_dropped() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("trials.csv");
        let mut store = TrialStore::open(&path).unwrap();
        store.append(trial("mug, blue")).unwrap();
        store.append(trial("lamp")).unwrap();
        drop(store);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 30]).unwrap();
        let mut store = TrialStore::open(&path).unwrap();
        assert_eq!(store.trials(), [trial("mug, blue")]);
        assert!(store.is_finished("mug, blue", 0) && !store.is_finished("lamp", 0));
        store.append(trial("lamp")).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn a_resumed_run_knows_the_numbers_of_the_first() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("trials.csv");
        let mut store = TrialStore::open(&path).unwrap();
        let mut thirds = trial("mug");
        thirds.outcomes.iter_mut().for_each(|outcome| outcome.psnr_db = 100.0 / 3.0);
        store.append(thirds).unwrap();
        assert_eq!(store.trials(), TrialStore::open(&path).unwrap().trials());
    }

    #[test]
    fn another_file_is_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("labels.csv");
        std::fs::write(&path, "a,b\n1,2\n").unwrap();
        assert!(matches!(TrialStore::open(&path), Err(TrialStoreError::Content { .. })));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "a,b\n1,2\n");
    }
}
