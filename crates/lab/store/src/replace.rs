//! A new result in the place of an old one.
//!
//! Where the old folder has nothing but ours, the two folders are exchanged. Otherwise the folder stays, with everything in it that is not
//! ours, and files are renamed one by one. A kill may come between two renames: the inventory says so (`moving`), and the next reader or
//! writer goes on ([`crate::mend()`]).

use crate::inventory::file_line;
use crate::place::{Place, name_of, on_its_way_out};
use crate::survey::{Survey, is_ours, is_partial, remove_partials};
use crate::{Error, INVENTORY, Inventory, disk, is_figure};
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::{Result as IoResult, Write};
use std::path::{Path, PathBuf};

/// Puts the result of a place over the one at `target`, and takes the old one away if the new one is
/// complete. Returns what stayed, in sentences.
///
/// # Errors
/// [`Error::Changed`], [`Error::Taken`], [`Error::WriteFailed`]; errors name `shown`.
pub(crate) fn replace(place: &Place, target: &Path, shown: &Path) -> Result<Vec<String>, Error> {
    let failed = |error: std::io::Error| Error::write_failed(shown, error);
    let new = place.result();
    let old = Inventory::read(target)?.ok_or_else(|| Error::NotOurs { path: shown.to_owned() })?;
    remove_partials(target, &old).map_err(failed)?; // the new inventory does not know them
    let mut survey = Survey::of(target, &old).map_err(failed)?;
    if let Some(name) = survey.changed.first() {
        return Err(Error::Changed { path: shown.join(name) });
    }
    let mut notes = Vec::new();
    for name in std::mem::take(&mut survey.edited) {
        let aside = set_aside(target, &name).map_err(failed)?;
        notes.push(format!("{} was edited: it is kept as {aside}", shown.join(&name).display()));
        survey.foreign.push(aside);
    }
    notes.extend(give_way(&new, target, shown, &old)?);
    append(target, &json!({ "gives_way_to": name_of(target) })).map_err(failed)?;
    if survey.foreign.is_empty() && disk::exchange(&new, target) {
        disk::sync_folder(target.parent().unwrap_or(Path::new("."))).map_err(failed)?;
    } else {
        announce(place, target).map_err(failed)?;
        forward(place, target, shown)?;
    }
    for old in [place.result(), place.old()] {
        retire(&old, target).map_err(failed)?;
    }
    Ok(notes)
}

/// Names that others have: figures are left out of the new result, other files are an error.
fn give_way(new: &Path, target: &Path, shown: &Path, old: &Inventory) -> Result<Vec<String>, Error> {
    let failed = |error: std::io::Error| Error::write_failed(shown, error);
    let mut inventory = Inventory::read(new)?.unwrap_or_default();
    let names: Vec<String> =
        inventory.files.keys().filter(|name| !old.files.contains_key(*name)).cloned().collect();
    let mut notes = Vec::new();
    for name in names.into_iter().filter(|name| is_taken(target, name)) {
        let path = shown.join(&name);
        if !is_figure(&name) {
            return Err(Error::Taken { path });
        }
        fs::remove_file(new.join(&name)).map_err(failed)?;
        inventory.files.remove(&name);
        notes.push(format!(
            "{} is kept, which motiform did not write: this figure is not written",
            path.display()
        ));
    }
    if !notes.is_empty() {
        disk::overwrite(&new.join(INVENTORY), inventory.text().as_bytes()).map_err(failed)?;
    }
    Ok(notes)
}

/// Returns `true` if a name, or that of a folder above it, is taken by something else than a new file needs.
pub(crate) fn is_taken(folder: &Path, name: &str) -> bool {
    let mut path = folder.to_owned();
    let parts: Vec<&str> = name.split('/').collect();
    parts.iter().enumerate().any(|(place, part)| {
        path.push(part);
        path.symlink_metadata().is_ok_and(|there| place + 1 == parts.len() || !there.is_dir())
    })
}

/// Renames a file so that its name is free; the new name.
pub(crate) fn set_aside(folder: &Path, name: &str) -> IoResult<String> {
    let (start, end) = name.rsplit_once('.').unwrap_or((name, ""));
    let aside = |count: &str| format!("{start}.edited{count}.{end}");
    let free = disk::rename_to_free(&folder.join(name), |count| folder.join(aside(count)))?;
    Ok(free.strip_prefix(folder).unwrap_or(&free).display().to_string())
}

/// Appends a line, after others, to the inventory of a folder.
fn append(folder: &Path, line: &Value) -> IoResult<()> {
    append_after(folder, "", line)
}

fn append_after(folder: &Path, lines: &str, last: &Value) -> IoResult<()> {
    let mut file = File::options().append(true).open(folder.join(INVENTORY))?;
    file.write_all(format!("\n{lines}{last}\n").as_bytes())?; // the first end is that of a line that was cut off
    file.sync_all()
}

/// Writes down what is about to be moved: the old inventory into the place, the new names into the folder's inventory.
fn announce(place: &Place, target: &Path) -> IoResult<()> {
    let old = place.old();
    fs::create_dir(&old)?;
    disk::write(&old.join(INVENTORY), &fs::read(target.join(INVENTORY))?)?;
    disk::sync_folder(&old)?;
    let new = Inventory::read(&place.result()).ok().flatten().unwrap_or_default();
    let mut lines = String::new();
    for (name, digests) in &new.files {
        digests.iter().for_each(|digest| lines += &file_line(name, digest));
    }
    append_after(target, &lines, &json!({ "moving": place.number() }))
}

/// Moves the old files out and the new ones in, as far as this is not done yet.
pub(crate) fn forward(place: &Place, target: &Path, shown: &Path) -> Result<(), Error> {
    let failed = |error: std::io::Error| Error::write_failed(shown, error);
    let (result, replaced) = (place.result(), place.old());
    let old = Inventory::read(&replaced)?.unwrap_or_default();
    let new = Inventory::read(&result)?.unwrap_or_default();
    for (name, digests) in &old.files {
        let moved_in = new.files.contains_key(name) && result.join(name).symlink_metadata().is_err();
        if !moved_in && is_ours(&target.join(name), digests).map_err(failed)? {
            make_folders(&replaced, name).map_err(failed)?;
            fs::rename(target.join(name), replaced.join(name)).map_err(failed)?;
        }
    }
    for name in new.files.keys().filter(|name| result.join(name).symlink_metadata().is_ok()) {
        if is_taken(target, name) {
            return Err(Error::Taken { path: shown.join(name) });
        }
        make_folders(target, name).map_err(failed)?;
        disk::rename_new(&result.join(name), &target.join(name)).map_err(failed)?;
    }
    disk::sync_folder(&replaced).map_err(failed)?;
    disk::rename(&result.join(INVENTORY), &target.join(INVENTORY)).map_err(failed)
}

/// Makes the folders above a file.
pub(crate) fn make_folders(folder: &Path, name: &str) -> IoResult<()> {
    match name.rsplit_once('/') {
        Some((above, _)) => fs::create_dir_all(folder.join(above)),
        None => Ok(()),
    }
}

/// Takes an old result away if the one that replaces it is complete; otherwise gives it a name beside that
/// one. Anything else than an old result stays.
pub(crate) fn retire(old: &Path, target: &Path) -> IoResult<()> {
    let read = |path: &Path| Inventory::read(path).ok().flatten();
    let hidden = old.parent() != target.parent();
    let successor =
        |found: &Inventory| if hidden { found.gives_way_to.clone() } else { found.replaced_by.clone() };
    let Some(inventory) = read(old).filter(|old| successor(old) == Some(name_of(target))) else {
        return Ok(());
    };
    if read(target).is_some_and(|new| new.complete) {
        take_away(old, target, &inventory)?;
    }
    if hidden && old.symlink_metadata().is_ok() { name_visibly(old, target) } else { Ok(()) }
}

/// Removes what is ours in an old result; what is not goes to the new one, if its name is free there.
fn take_away(old: &Path, target: &Path, inventory: &Inventory) -> IoResult<()> {
    for (name, digests) in &inventory.files {
        if is_ours(&old.join(name), digests)? {
            fs::remove_file(old.join(name))?;
        }
    }
    let mut above: Vec<&str> =
        inventory.files.keys().filter_map(|name| Some(name.rsplit_once('/')?.0)).collect();
    above.sort_unstable_by_key(|folder| std::cmp::Reverse(folder.len()));
    for folder in above {
        let _ = fs::remove_dir(old.join(folder)); // it fails where something is inside
    }
    for entry in fs::read_dir(old)?.collect::<IoResult<Vec<_>>>()? {
        let name = entry.file_name().to_string_lossy().into_owned();
        if is_partial(&name, inventory) {
            fs::remove_file(entry.path())?;
        } else if name != INVENTORY && old.parent() != target.parent() {
            let _ = disk::rename_new(&entry.path(), &target.join(entry.file_name())); // otherwise it stays with the old one
        }
    }
    if fs::read_dir(old)?.count() > 1 {
        return Ok(());
    }
    // Without its inventory nobody would know what an empty folder of this name is.
    let last = if old.parent() == target.parent() { on_its_way_out(target) } else { old.to_owned() };
    if last != old {
        fs::rename(old, &last)?;
    }
    fs::remove_file(last.join(INVENTORY))?;
    fs::remove_dir(last)
}

/// `run` -> `run.replaced`, or with a number.
fn name_visibly(old: &Path, target: &Path) -> IoResult<()> {
    append(old, &json!({ "replaced_by": name_of(target) }))?;
    let visible = |count: &str| target.with_file_name(format!("{}.replaced{count}", name_of(target)));
    disk::rename_to_free(old, visible).map(drop)
}

/// Returns `true` if a folder beside `target` is a result that it replaced.
pub(crate) fn retires(old: &Path, target: &Path) -> bool {
    let inventory = Inventory::read(old).ok().flatten();
    inventory.is_some_and(|old| old.replaced_by == Some(name_of(target)))
}

/// Folders beside `target` that may be results that it replaced.
pub(crate) fn replaced(target: &Path) -> Vec<PathBuf> {
    let start = format!("{}.replaced", name_of(target));
    let folder = target.parent().unwrap_or(Path::new("."));
    let names = fs::read_dir(folder).into_iter().flatten().flatten();
    names
        .filter(|entry| entry.file_name().to_string_lossy().starts_with(&start))
        .map(|entry| entry.path())
        .collect()
}
