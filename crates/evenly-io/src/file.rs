//! Files and streams: read whole, written whole or not at all.

use std::ffi::OsStr;
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::memory::{memory_limit, require};
use crate::shapes::{SHAPEFILE, read_points_of_map};
use crate::{Error, Extent, Format, Table, npy, table, text};

/// Reads points from a file, or from stdin for `-`. Numpy arrays and GeoJSON are known by their first bytes, all else is text.
///
/// # Errors
/// [`Error`] with the file's name, and the line where there is one.
pub fn read_positions(path: &Path) -> Result<Vec<[f64; 2]>, Error> {
    Ok(read_table(path)?.positions)
}

/// Reads points and the other columns of their file, where a first line names them.
///
/// # Errors
/// As [`read_positions`].
pub fn read_table(path: &Path) -> Result<Table, Error> {
    let (name, bytes) = read_bytes(path)?;
    let extent = Extent::find(&bytes);
    let of_points = |positions| Table { positions, extent, ..Table::default() };
    if bytes.starts_with(b"\x93NUMPY") {
        return npy::read(&name, &bytes).map(of_points);
    }
    if bytes.starts_with(SHAPEFILE) {
        return read_points_of_map(&name, &bytes).map(of_points);
    }
    if text::plain(&bytes).trim_ascii_start().starts_with(b"{") {
        return read_points_of_map(&name, &bytes).map(of_points);
    }
    match table::read(&name, &bytes)? {
        Some(table) => Ok(Table { extent, ..table }),
        None => text::read(&name, &bytes).map(of_points),
    }
}

/// Reads three numbers a line from text: a point, and what is said of it.
///
/// # Errors
/// As [`read_positions`].
pub fn read_rows(path: &Path) -> Result<Vec<[f64; 3]>, Error> {
    let (name, bytes) = read_bytes(path)?;
    text::read_rows(&name, &bytes)
}

/// Reads a number a line from text.
///
/// # Errors
/// As [`read_positions`].
pub fn read_numbers(path: &Path) -> Result<Vec<f64>, Error> {
    let (name, bytes) = read_bytes(path)?;
    Ok(text::read_rows::<1>(&name, &bytes)?.into_iter().map(|[number]| number).collect())
}

/// A file's name for messages, and all that is in it; `-` is stdin.
pub(crate) fn read_bytes(path: &Path) -> Result<(String, Vec<u8>), Error> {
    let name = display_name(path, "stdin");
    let most = memory_limit();
    let (source, length): (Box<dyn std::io::Read>, u64) = if path == OsStr::new("-") {
        (Box::new(std::io::stdin().lock()), 0)
    } else {
        let file = std::fs::File::open(path).map_err(Error::io(&name))?;
        let length = file.metadata().map_or(0, |of| of.len());
        (Box::new(file), length)
    };
    // What is read takes as much again. Streams, and what is no plain file, do not tell how long they are.
    require(&name, length.saturating_mul(2))?;
    let mut bytes = Vec::with_capacity(length as usize);
    source.take(most / 2).read_to_end(&mut bytes).map_err(Error::io(&name))?;
    if bytes.len() as u64 == most / 2 {
        return Err(Error::Memory { name, needed: most, allowed: most });
    }
    Ok((name, bytes))
}

/// Where an output goes, checked before the work begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    path: PathBuf,
    format: Format,
    may_overwrite: bool,
}

impl Target {
    /// A file, or stdout for `-`. The format is the file's ending unless it is given; for stdout it is text unless given.
    ///
    /// # Errors
    /// An unknown ending, a file that exists (unless it may be overwritten), a folder that does not exist or cannot be written.
    pub fn new(path: &Path, format: Option<Format>, may_overwrite: bool) -> Result<Self, Error> {
        let is_stdout = STDOUT.iter().any(|name| path == OsStr::new(name));
        let format = match format {
            Some(format) => format,
            None if is_stdout => Format::Txt,
            None => Format::of_path(path)?,
        };
        let target = Self { path: if is_stdout { "-".into() } else { path.to_owned() }, format, may_overwrite };
        if is_stdout {
            require_stdout()?;
        } else {
            target.check_writable()?;
        }
        Ok(target)
    }

    /// A file of any content, whatever its ending.
    ///
    /// # Errors
    /// As [`Self::new`], but for the ending.
    pub fn any(path: &Path, may_overwrite: bool) -> Result<Self, Error> {
        Self::new(path, Some(Format::Txt), may_overwrite)
    }

    /// A picture of pixels.
    ///
    /// # Errors
    /// As [`Self::new`], and an ending that is not `.png`.
    pub fn picture(path: &Path, may_overwrite: bool) -> Result<Self, Error> {
        Self::of_kind(path, may_overwrite, "a picture has pixels", |format| format == Format::Png)
    }

    /// A figure.
    ///
    /// # Errors
    /// As [`Self::new`], and an ending of points.
    pub fn figure(path: &Path, may_overwrite: bool) -> Result<Self, Error> {
        Self::of_kind(path, may_overwrite, "no format of figures", |format| !format.holds_points())
    }

    fn of_kind(path: &Path, may_overwrite: bool, problem: &'static str, is_good: impl Fn(Format) -> bool) -> Result<Self, Error> {
        match Format::of_path(path) {
            Ok(format) if is_good(format) => Self::new(path, None, may_overwrite),
            _ => Err(Error::Format { name: path.display().to_string(), problem, choices: Format::endings(is_good) }),
        }
    }

    /// Whether it is stdout.
    pub fn is_stdout(&self) -> bool {
        self.path == OsStr::new("-")
    }

    /// The name for messages.
    pub fn name(&self) -> String {
        display_name(&self.path, "stdout")
    }

    /// What will be written.
    pub fn format(&self) -> Format {
        self.format
    }

    /// That it holds points where a figure was wanted.
    pub(crate) fn no_figure(&self) -> Error {
        let choices = Format::endings(|format| !format.holds_points());
        Error::Format { name: self.name(), problem: "this is a format of points", choices }
    }

    /// The same name with another ending, beside it.
    ///
    /// # Errors
    /// As [`Self::new`]; for stdout, which has no name.
    pub fn beside(&self, format: Format) -> Result<Self, Error> {
        if self.is_stdout() {
            return Err(Error::content(self.name(), "this has no name that another file could have beside it"));
        }
        let name = Format::ALL.iter().find(|(_, known)| *known == format).map_or("", |(name, _)| name);
        Self::new(&self.path.with_extension(name), Some(format), self.may_overwrite)
    }

    /// Whether both are the same file, or both stdout.
    pub fn is_same(&self, other: &Self) -> bool {
        let place = |target: &Self| {
            let file = std::path::absolute(target.file()).unwrap_or_else(|_| target.file());
            let folder = file.parent().and_then(|folder| folder.canonicalize().ok());
            folder.zip(file.file_name().map(OsStr::to_owned))
        };
        self.path == other.path || (!self.is_stdout() && !other.is_stdout() && place(self).is_some() && place(self) == place(other))
    }

    fn check_writable(&self) -> Result<(), Error> {
        if self.path.is_dir() {
            return Err(Error::content(self.name(), "this is a directory; name a file in it"));
        }
        if self.is_device() {
            return Ok(());
        }
        if self.path.is_symlink() && !self.path.exists() {
            return Err(Error::content(self.name(), "this is a link to a file that does not exist"));
        }
        if !self.may_overwrite && self.path.exists() {
            return Err(Error::Exists(self.name()));
        }
        self.temporary().map(drop)
    }

    /// Whether it is a device or a pipe, such as /dev/null: written as it is, never replaced.
    fn is_device(&self) -> bool {
        self.path.metadata().is_ok_and(|file| !file.is_file() && !file.is_dir())
    }

    fn open_device(&self) -> Result<std::fs::File, Error> {
        std::fs::OpenOptions::new().write(true).open(&self.path).map_err(Error::io(&self.name()))
    }

    /// The file that takes the content: what a link names, not the link.
    fn file(&self) -> PathBuf {
        self.path.canonicalize().unwrap_or_else(|_| self.path.clone())
    }

    /// An empty file beside the target, gone when dropped.
    fn temporary(&self) -> Result<Temporary, Error> {
        let file = self.file();
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".evenly-");
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let made = Temporary::new(|| builder.tempfile_in(folder));
        made.map_err(|e| match e.kind() {
            std::io::ErrorKind::NotFound => Error::content(self.name(), "its folder does not exist"),
            // The reason alone: the temporary file's own name says nothing to anybody.
            kind => Error::io(&self.name())(kind.into()),
        })
    }

    /// Writes everything: to a temporary file that then takes the target's name, or to stdout.
    ///
    /// # Errors
    /// What the operating system says; the target is then as it was before.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Error> {
        write_together(&[(self, bytes)])
    }

    /// Writes what can be taken back: `None` for streams, which are written at the end.
    fn stage(&self, bytes: &[u8]) -> Result<Option<Temporary>, Error> {
        if self.is_stdout() || self.is_device() {
            return Ok(None);
        }
        let name = self.name();
        let mut staged = self.temporary()?;
        let file = &mut staged.file;
        file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(Error::io(&name))?;
        if let Ok(old) = self.file().metadata() {
            file.as_file().set_permissions(old.permissions()).map_err(Error::io(&name))?;
        }
        Ok(Some(staged))
    }

    fn persist(&self, staged: Option<Temporary>, bytes: &[u8]) -> Result<(), Error> {
        let name = self.name();
        match staged {
            None if self.is_stdout() => write_stream(&mut std::io::stdout().lock(), bytes).map_err(Error::io(&name)),
            None => write_stream(&mut self.open_device()?, bytes).map_err(Error::io(&name)),
            Some(staged) => staged.persist(&self.file(), self.may_overwrite).map_err(|e| match e.kind() {
                std::io::ErrorKind::AlreadyExists => Error::Exists(name),
                _ => Error::Io { name, reason: e },
            }),
        }
    }
}

/// Writes several files, all of them or none.
///
/// # Errors
/// As [`Target::write`].
pub fn write_together(all: &[(&Target, &[u8])]) -> Result<(), Error> {
    let staged: Vec<Option<Temporary>> = all.iter().map(|(target, bytes)| target.stage(bytes)).collect::<Result<_, _>>()?;
    all.iter().zip(staged).try_for_each(|((target, bytes), staged)| target.persist(staged, bytes))
}

/// Names of stdout.
const STDOUT: [&str; 4] = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// That stdout is open. Where it was closed, the standard library has put a device in its place, open for
/// reading too.
fn require_stdout() -> Result<(), Error> {
    let is_null = std::fs::read_link("/proc/self/fd/1").is_ok_and(|file| file == Path::new("/dev/null"));
    let flags = std::fs::read_to_string("/proc/self/fdinfo/1").unwrap_or_default();
    let flags = flags.lines().find_map(|line| u32::from_str_radix(line.strip_prefix("flags:")?.trim(), 8).ok());
    let is_read = flags.is_some_and(|flags| flags & 3 == 2);
    if is_null && is_read { Err(Error::content("stdout", "it is closed")) } else { Ok(()) }
}

/// A file under a name of its own until it is whole.
struct Temporary {
    file: tempfile::NamedTempFile,
}

/// Those that are there now.
static TEMPORARIES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

impl Temporary {
    fn new(make: impl FnOnce() -> std::io::Result<tempfile::NamedTempFile>) -> std::io::Result<Self> {
        let mut all = TEMPORARIES.lock().unwrap_or_else(PoisonError::into_inner);
        let file = make()?;
        all.push(file.path().to_owned());
        Ok(Self { file })
    }

    fn persist(self, to: &Path, may_overwrite: bool) -> std::io::Result<()> {
        let from = self.file.path().to_owned();
        let kept = if may_overwrite { self.file.persist(to) } else { self.file.persist_noclobber(to) };
        TEMPORARIES.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| *path != from);
        kept.map(drop).map_err(|e| e.error)
    }
}

/// Removes the files that have not got their names yet, for a process that is about to end.
pub fn discard_temporaries() {
    // No other is made from here on.
    let all = TEMPORARIES.lock().unwrap_or_else(PoisonError::into_inner);
    for path in all.iter() {
        // It may be gone.
        let _ = std::fs::remove_file(path);
    }
    std::mem::forget(all);
}

/// Makes a folder, and those that it lies in, where they are missing.
///
/// # Errors
/// What the operating system says.
pub fn make_folder(path: &Path) -> Result<(), Error> {
    if path.exists() && !path.is_dir() {
        return Err(Error::content(path.display().to_string(), "this is a file; name a folder"));
    }
    std::fs::create_dir_all(path).map_err(Error::io(&path.display().to_string()))
}

/// Writes to a stream; if whoever reads has seen enough, that is no error.
fn write_stream(stream: &mut impl std::io::Write, bytes: &[u8]) -> std::io::Result<()> {
    match stream.write_all(bytes).and_then(|()| stream.flush()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

fn display_name(path: &Path, stream: &str) -> String {
    if path == OsStr::new("-") { stream.into() } else { path.display().to_string() }
}
