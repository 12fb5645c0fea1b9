//! What a long run has done so far, so that it can go on after an interruption.

use std::path::{Path, PathBuf};

use crate::file::make_folder;
use crate::{Error, Target};

/// Texts by name, in a folder of their own.
#[derive(Debug)]
pub struct Scraps {
    folder: PathBuf,
}

impl Scraps {
    /// The folder, which is made with the first text.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }

    /// Whether a run was left here.
    pub fn exist(&self) -> bool {
        self.folder.is_dir()
    }

    /// What was kept under a name.
    pub fn get(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.folder.join(name)).ok()
    }

    /// Keeps a text.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn put(&self, name: &str, text: &str) -> Result<(), Error> {
        make_folder(&self.folder)?;
        Target::any(&self.folder.join(name), true)?.write(text.as_bytes())
    }

    /// Throws all away.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn clear(&self) -> Result<(), Error> {
        if !self.exist() {
            return Ok(());
        }
        std::fs::remove_dir_all(&self.folder).map_err(Error::io(&self.folder.display().to_string()))
    }
}
