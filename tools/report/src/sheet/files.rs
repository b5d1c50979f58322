//! Where the CSV files of a report are, and those that were read.

use super::Sheet;
use crate::ReportError;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Where the files of a report are, and the sheets that were read. A clone shares them.
#[derive(Clone, Debug, Default)]
pub struct Sheets {
    folder: PathBuf,
    /// The folder beyond which nothing is read, if there is one.
    bounds: Option<PathBuf>,
    read: Arc<Mutex<BTreeMap<String, Arc<Sheet>>>>,
}

impl Sheets {
    /// Files named from this folder.
    #[must_use]
    pub fn of_folder(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), ..Self::default() }
    }

    /// The same, of which none lies outside `bounds`, wherever links lead; and only files are read, no devices.
    #[must_use]
    pub fn within(self, bounds: &Path) -> Self {
        Self { bounds: Some(bounds.to_owned()), ..self }
    }

    /// A table that is there already, as if it were a file of this name.
    ///
    /// # Errors
    /// If it is not CSV.
    pub fn add(&self, name: &str, csv: &[u8]) -> Result<Arc<Sheet>, ReportError> {
        let sheet = Arc::new(Sheet::parse(name, csv)?);
        self.read.lock().unwrap_or_else(PoisonError::into_inner).insert(name.to_owned(), Arc::clone(&sheet));
        Ok(sheet)
    }

    /// A table, read now or before.
    ///
    /// # Errors
    /// If it cannot be read, or is not CSV.
    pub fn get(&self, name: &str) -> Result<Arc<Sheet>, ReportError> {
        let known = self.read.lock().unwrap_or_else(PoisonError::into_inner).get(name).cloned();
        match known {
            Some(sheet) => Ok(sheet),
            None => self.add(name, &self.bytes(name)?),
        }
    }

    /// The bytes of any file.
    ///
    /// # Errors
    /// If it cannot be read, or lies where nothing is to be read.
    pub fn bytes(&self, name: &str) -> Result<Vec<u8>, ReportError> {
        let failed = |error: std::io::Error| ReportError::read(format!("{name}: {error}"));
        let path = self.folder.join(name);
        if let Some(bounds) = &self.bounds {
            let (file, folder) = (fs::canonicalize(&path).map_err(failed)?, fs::canonicalize(bounds).map_err(failed)?);
            if !file.starts_with(folder) {
                return Err(ReportError::asked(format!(
                    "{name}: outside the folder of the page, whose files alone are read; --anyway reads it too"
                )));
            }
            if !fs::metadata(&file).map_err(failed)?.is_file() {
                return Err(ReportError::asked(format!("{name}: no file")));
            }
        }
        fs::read(path).map_err(failed)
    }
}
