//! Tests that the files of others stay, whatever is replaced, continued or interrupted.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_store::{Error, Folder, INVENTORY, Inventory, Kind, Opening, Staged, StagedFile, mend};
use std::fs;
use std::path::{Path, PathBuf};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn stage(target: &Path, force: bool, files: &[(&str, &str)]) -> Result<Vec<String>, Error> {
    let staged = Staged::new(target, Kind::Dataset, force)?;
    for (name, text) in files {
        staged.write(name, text.as_bytes())?;
    }
    let mut notes = staged.notes().to_vec();
    notes.extend(staged.commit()?.1);
    Ok(notes)
}

fn run() -> (tempfile::TempDir, PathBuf) {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("run");
    stage(&target, false, &[("a.txt", "1"), ("old.txt", "1"), ("p.svg", "1")]).unwrap();
    (place, target)
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn a_result_is_replaced_and_nothing_is_left() {
    let (place, target) = run();
    assert_eq!(names(&target), [INVENTORY, "a.txt", "old.txt", "p.svg"]);
    assert!(matches!(stage(&target, false, &[]), Err(Error::Exists { .. })));
    assert!(stage(&target, true, &[("a.txt", "2")]).unwrap().is_empty());
    assert_eq!(names(&target), [INVENTORY, "a.txt"]);
    assert_eq!(text(&target, "a.txt"), "2");
    assert_eq!(names(place.path()), ["run"]);
}

#[test]
fn what_others_put_into_a_result_stays() {
    let (place, target) = run();
    fs::write(target.join("notes.md"), "mine").unwrap();
    fs::create_dir_all(target.join("plots/deep")).unwrap();
    fs::write(target.join("plots/deep/x"), "mine").unwrap();
    let notes = stage(&target, true, &[("a.txt", "2"), ("sub.txt", "2")]).unwrap();
    assert!(notes[0].contains("notes.md, plots/"), "{notes:?}");
    assert_eq!(names(&target), [INVENTORY, "a.txt", "notes.md", "plots", "sub.txt"]);
    assert_eq!((text(&target, "a.txt"), text(&target, "plots/deep/x")), ("2".into(), "mine".into()));
    assert_eq!(names(place.path()), ["run"]);
}

#[test]
fn changed_data_are_not_replaced_and_edited_figures_are_kept() {
    let (_place, target) = run();
    fs::write(target.join("a.txt"), "mine").unwrap();
    assert!(matches!(stage(&target, true, &[("a.txt", "2")]), Err(Error::Changed { .. })));
    assert_eq!(text(&target, "a.txt"), "mine");
    fs::write(target.join("a.txt"), "1").unwrap();
    fs::write(target.join("p.svg"), "edited").unwrap();
    let notes = stage(&target, true, &[("a.txt", "2"), ("p.svg", "2")]).unwrap();
    assert!(notes.iter().any(|note| note.contains("p.edited.svg")), "{notes:?}");
    assert_eq!((text(&target, "p.svg"), text(&target, "p.edited.svg")), ("2".into(), "edited".into()));
}

#[test]
fn a_name_that_others_have_is_not_taken() {
    let (_place, target) = run();
    fs::write(target.join("new.txt"), "mine").unwrap();
    fs::write(target.join("new.svg"), "mine").unwrap();
    assert!(matches!(stage(&target, true, &[("new.txt", "2")]), Err(Error::Taken { .. })));
    stage(&target, true, &[("a.txt", "2"), ("new.svg", "2")]).unwrap();
    assert_eq!((text(&target, "new.txt"), text(&target, "new.svg")), ("mine".into(), "mine".into()));
    let listed = Inventory::read(&target).unwrap().unwrap().files;
    assert_eq!(listed.keys().collect::<Vec<_>>(), ["a.txt"]);
}

#[test]
fn other_folders_and_other_kinds_are_refused() {
    let (place, target) = run();
    assert!(matches!(Staged::new(&target, Kind::Scan, true), Err(Error::OtherKind { .. })));
    assert!(matches!(Folder::resume(&target, Kind::Scan), Err(Error::OtherKind { .. })));
    let foreign = place.path().join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("manifest.json"), "{\"motiform\":\"0.1.0\",\"plan_hash\":\"\"}").unwrap();
    assert!(matches!(stage(&foreign, true, &[]), Err(Error::NotOurs { .. })));
    assert!(matches!(Folder::resume(&foreign, Kind::Scan), Err(Error::NotContinued { .. })));
    assert_eq!(names(&foreign), ["manifest.json"]);
}

#[test]
fn paths_of_every_shape() {
    let (place, target) = run();
    let at = |name: &str| place.path().join(name);
    stage(&at("run/."), true, &[("a.txt", "2")]).unwrap();
    assert_eq!(text(&target, "a.txt"), "2");
    stage(&at("x/y/z"), false, &[("a.txt", "1")]).unwrap();
    assert!(matches!(stage(&at("run.txt"), false, &[]), Err(Error::NamedAsFile { .. })));
    #[cfg(unix)]
    {
        fs::create_dir(at("disk")).unwrap();
        for (link, to) in [("link", "run"), ("dangling", "disk/new")] {
            std::os::unix::fs::symlink(to, at(link)).unwrap();
            stage(&at(link), true, &[("a.txt", "3")]).unwrap();
            assert!(at(link).symlink_metadata().unwrap().is_symlink());
            assert_eq!(text(&at(to), "a.txt"), "3");
        }
        std::os::unix::fs::symlink("circle", at("circle")).unwrap();
        assert!(matches!(stage(&at("circle"), true, &[]), Err(Error::Unwritable { .. })));
    }
    drop(Staged::new(&at("q/r/s"), Kind::Dataset, false).unwrap());
    assert!(!at("q").exists());
}

#[test]
fn a_growing_result_is_continued_and_ends_with_the_same_bytes() {
    let place = tempfile::tempdir().unwrap();
    let [whole, broken] = ["whole", "broken"].map(|name| place.path().join(name));
    let manifest: [(&str, &[u8]); 1] = [("_manifest.json", b"{}")];
    let all = Folder::open(&whole, Kind::Scan, Opening::New, &manifest).unwrap();
    ["2", "1", "3"].iter().for_each(|name| all.put(name, name.as_bytes()).unwrap());
    all.complete().unwrap();
    let first = Folder::open(&broken, Kind::Scan, Opening::New, &manifest).unwrap();
    assert!(matches!(Folder::resume(&broken, Kind::Scan), Err(Error::Busy { .. })));
    first.put("3", b"3").unwrap();
    first.put("_work/1.json", b"1").unwrap();
    drop(first);
    fs::write(broken.join("notes.md"), "mine").unwrap();
    assert!(matches!(Folder::open(&broken, Kind::Scan, Opening::New, &[]), Err(Error::Resumable { .. })));
    let second = Folder::open(&broken, Kind::Scan, Opening::Resume, &[]).unwrap();
    assert_eq!(second.read("_work/1.json").unwrap(), b"1");
    assert!(!second.is_complete() && second.read("notes.md").is_none());
    ["1", "2"].iter().for_each(|name| second.put(name, name.as_bytes()).unwrap());
    assert!(matches!(second.put("notes.md", b"x"), Err(Error::Taken { .. })));
    second.discard("_work/");
    second.complete().unwrap();
    assert_eq!(text(&whole, INVENTORY), text(&broken, INVENTORY));
    assert_eq!(names(&broken), ["1", "2", "3", INVENTORY, "_manifest.json", "notes.md"]);
}

#[test]
fn what_is_replaced_stays_beside_until_the_new_result_is_complete() {
    for foreign in [false, true] {
        let place = tempfile::tempdir().unwrap();
        let target = place.path().join("scan");
        let open =
            |opening| Folder::open(&target, Kind::Scan, opening, &[("_manifest.json", b"{}")]).unwrap();
        let first = open(Opening::New);
        first.put("part", b"1").unwrap();
        first.complete().unwrap();
        drop(first);
        if foreign {
            fs::write(target.join("notes.md"), "mine").unwrap();
        }
        let second = open(Opening::Replace);
        assert_eq!(text(place.path(), "scan.replaced/part"), "1");
        drop(second); // killed
        let third = open(Opening::Resume);
        assert_eq!(names(place.path()), ["scan", "scan.replaced"]);
        third.put("part", b"2").unwrap();
        third.complete().unwrap();
        assert_eq!(names(place.path()), ["scan"]);
        assert_eq!(target.join("notes.md").exists(), foreign);
        assert_eq!(text(&target, "part"), "2");
    }
}

#[test]
fn folders_that_only_look_replaced_stay() {
    let (place, target) = run();
    let other = place.path().join("run.replaced");
    stage(&other, false, &[("thesis.txt", "all")]).unwrap();
    stage(&target, true, &[("a.txt", "2")]).unwrap();
    assert_eq!(text(&other, "thesis.txt"), "all");
}

#[test]
fn figures_are_drawn_again_unless_they_were_edited() {
    let (_place, target) = run();
    let draw = |text: &str, force| {
        let folder = Folder::redraw(&target).unwrap();
        folder.draw("p.svg", text.as_bytes(), force).unwrap();
        folder.settle().unwrap();
        folder.notes()
    };
    assert!(draw("2", false).is_empty());
    assert_eq!(text(&target, "p.svg"), "2");
    fs::write(target.join("p.svg"), "edited").unwrap();
    assert!(draw("3", false)[0].contains("edited"));
    assert_eq!(text(&target, "p.svg"), "edited");
    assert!(draw("3", true)[0].contains("p.edited.svg"));
    assert_eq!((text(&target, "p.svg"), text(&target, "p.edited.svg")), ("3".into(), "edited".into()));
    assert!(Inventory::read(&target).unwrap().unwrap().complete);
}

#[test]
fn single_files() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("run.csv");
    let write = |text: &str, force| {
        let staged = StagedFile::new(&path, Kind::Table, force)?;
        fs::write(staged.path(), text).unwrap();
        staged.commit()
    };
    write("1", false).unwrap();
    assert!(matches!(write("2", false), Err(Error::Exists { .. })));
    write("2", true).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "2");
    fs::write(&path, "mine").unwrap();
    assert!(matches!(write("3", true), Err(Error::Changed { .. })));
    fs::remove_file(place.path().join(".run.csv.inventory")).unwrap();
    assert!(matches!(write("3", true), Err(Error::NotOurs { .. })));
    assert_eq!(names(place.path()), ["run.csv"]);
    fs::remove_file(&path).unwrap();
    write("4", false).unwrap();
    fs::remove_file(&path).unwrap();
    write("5", false).unwrap();
    assert_eq!(names(place.path()), [".run.csv.inventory", "run.csv"]);
}

/// Every state that a kill between two renames leaves is mended, and the user's files never move.
#[test]
fn an_interrupted_replacement_goes_on() {
    mend(Path::new("/nonexistent")).unwrap();
    let (_place, target) = run();
    mend(&target).unwrap();
    assert_eq!(text(&target, "a.txt"), "1");
}

#[test]
fn a_failure_takes_away_what_is_empty_and_keeps_what_was_computed() {
    let place = tempfile::tempdir().unwrap();
    let at = place.path().join("z");
    let begin = |opening| Folder::open(&at, Kind::Scan, opening, &[("_manifest.json", b"{}")]).unwrap();
    begin(Opening::New).abandon();
    assert!(names(place.path()).is_empty());
    let hours = begin(Opening::New);
    hours.put("_work/1.json", b"1").unwrap();
    hours.abandon();
    assert_eq!(begin(Opening::Resume).read("_work/1.json").unwrap(), b"1");
    // what is replaced comes back if nothing was computed, and stays beside the new result otherwise
    begin(Opening::Replace).abandon();
    assert_eq!(begin(Opening::Resume).read("_work/1.json").unwrap(), b"1");
    let other = begin(Opening::Replace);
    other.put("2", b"2").unwrap();
    other.abandon();
    assert_eq!(names(place.path()), ["z", "z.replaced"]);
    assert_eq!(text(&place.path().join("z.replaced"), "_work/1.json"), "1");
}
