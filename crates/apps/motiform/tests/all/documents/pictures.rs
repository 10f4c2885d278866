//! Pictures of the documents: each is what the commands of a page write.

use super::page::{self, Page};
use super::root;
use super::session::Session;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A picture of a page: the file that is shown, and the one that the commands write.
struct Picture {
    shown: PathBuf,
    made: Option<String>,
}

/// `![what](images/zigzag.png "zigzag/path.png")`, wherever it stands.
fn pictures(page: &Page) -> Vec<Picture> {
    let folder = page.path.parent().unwrap();
    let targets = page.text.split("![").skip(1).filter_map(|rest| rest.split_once("](")?.1.split_once(')'));
    let picture = |(target, _): (&str, &str)| {
        let (file, made) = target.split_once(' ').map_or((target, None), |(file, title)| (file, Some(title)));
        Picture {
            shown: folder.join(file),
            made: made.map(|title| title.trim().trim_matches('"').to_owned()),
        }
    };
    targets.map(picture).collect()
}

/// Pictures that differ from those that the commands of the page wrote; written with `MOTIFORM_UPDATE`. A picture of a slow command
/// waits for it.
pub(super) fn compare(page: &Page, session: &Session) -> Vec<String> {
    let mut faults = Vec::new();
    for Picture { shown, made } in pictures(page) {
        let Some(made) = made else { continue };
        let path = session.folder.path(&made);
        if !path.exists() && !session.complete {
            println!("left to `cargo xtask documents`: {}: {}", page.name, shown.display());
            continue;
        }
        let Ok(bytes) = fs::read(&path) else {
            faults.push(format!("no command of the page writes {made}"));
            continue;
        };
        if std::env::var_os("MOTIFORM_UPDATE").is_some() {
            fs::create_dir_all(shown.parent().unwrap()).unwrap();
            fs::write(&shown, &bytes).unwrap();
        }
        if fs::read(&shown).ok() != Some(bytes) {
            faults.push(format!(
                "{} is not {made} as it is written now: cargo xtask pictures",
                shown.display()
            ));
        }
    }
    faults
}

/// Each picture has exactly one page whose commands make it, and each file is shown.
#[test]
fn every_picture_has_its_command() {
    let mut made: BTreeMap<PathBuf, usize> = BTreeMap::new();
    for page in page::all() {
        for picture in pictures(&page) {
            let path = picture.shown.canonicalize().unwrap_or_else(|_| panic!("{}", picture.shown.display()));
            *made.entry(path).or_default() += usize::from(picture.made.is_some());
        }
    }
    for (path, times) in &made {
        assert_eq!(*times, 1, "{}: the pages whose commands make it", path.display());
    }
    let mut bytes = 0;
    for path in files(&root().join("docs")) {
        assert!(made.contains_key(&path), "{} is on no page", path.display());
        bytes += path.metadata().unwrap().len();
    }
    assert!(bytes < 3_000_000, "{bytes} bytes of pictures");
}

/// Pictures in a folder and the folders in it.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let built = path.ends_with("site");
        if path.is_dir() && !built {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|end| end == "png" || end == "svg") {
            found.push(path.canonicalize().unwrap());
        }
    }
    found
}
