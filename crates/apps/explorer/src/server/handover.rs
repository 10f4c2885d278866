//! A file that leads a browser to the page.
//!
//! The arguments of a program can be read by everybody on the machine, so the address with its token must not be among them: the browser
//! is given this file, which its owner alone can read.

use crate::server::Error;
use crate::server::guard::Token;
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The file; it is removed with this value.
#[derive(Debug)]
pub struct Handover {
    path: PathBuf,
}

impl Handover {
    /// Writes a file that redirects to `address`, in the user's folder for running programs or, where there
    /// is none, in that of temporary files.
    ///
    /// # Errors
    /// The folder cannot be written to, or the system provides no random numbers.
    pub fn new(address: &str) -> Result<Self, Error> {
        let running = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from).filter(|path| path.is_dir());
        Self::within(&running.unwrap_or_else(std::env::temp_dir), address)
    }

    /// Writes the file into this folder.
    fn within(folder: &Path, address: &str) -> Result<Self, Error> {
        // Nobody can have made a file of this name before.
        let path = folder.join(format!("motiform-{}.html", Token::random()?.text()));
        let mut file = private(&path)?;
        let made = Self { path };
        file.write_all(redirection(address).as_bytes())?;
        Ok(made)
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Handover {
    fn drop(&mut self) {
        // A file that was removed before does no harm.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// A new file that its owner alone can read.
fn private(path: &Path) -> std::io::Result<File> {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)
}

/// A page that goes to an address at once; where that is not allowed, it has a link.
fn redirection(address: &str) -> String {
    let address = address.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">\n\
         <meta http-equiv=\"refresh\" content=\"0; url={address}\"><title>motiform</title></head>\n\
         <body><p><a href=\"{address}\">Open the explorer</a></p></body></html>\n"
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    #[test]
    fn its_owner_alone_reads_it_and_it_goes_with_the_server() {
        let address = "http://127.0.0.1:7373/0123456789abcdef/#model=a\"b<c&d.toml";
        let handover = Handover::within(&std::env::temp_dir(), address).unwrap();
        let path = handover.path().to_owned();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
        }
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(
            text.contains("url=http://127.0.0.1:7373/0123456789abcdef/#model=a&quot;b&lt;c&amp;d.toml\">"),
            "{text}"
        );
        assert!(!path.display().to_string().contains("0123456789abcdef/"));
        drop(handover);
        assert!(!path.exists());
    }
}
