//! `motiform equilibria` and `motiform section`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Folder, keys};

#[test]
fn equilibria_are_listed_with_their_stability() {
    let folder = Folder::new();
    let words = "equilibria tensor --preset fig4 --set kappa2=1.5 --set kappa3=0.1 --starts 60";
    let json = folder.run(&format!("{words} --json")).expect(0).json();
    let found = json["equilibria"].as_array().unwrap();
    let stable: Vec<_> = found.iter().filter(|one| one["unstable"] == 0).collect();
    assert!(!stable.is_empty() && stable.iter().all(|one| one["motion"] == "circular"), "{json}");
    assert!(
        found.iter().any(|one| one["motion"] == "motionless")
            && found.iter().any(|one| one["motion"] == "straight")
    );
    assert_eq!(keys(&found[0]["shape"]), ["v1", "v2", "s11", "s12", "u111", "u222"]);
    let table = folder.run(words).expect(0).stdout;
    assert_eq!(table.lines().count(), 2 + found.len(), "{table}");
    assert!(table.contains(&format!("{} found; nothing proves that these are all", found.len())), "{table}");
    assert_eq!(json["complete"], "not proven");
}

#[test]
fn a_section_lists_crossings() {
    let folder = Folder::new();
    let words = "section tensor --preset fig5a --at s12=0.1 --t-end 300";
    let table = folder.run(words).expect(0).stdout;
    assert!(table.starts_with("t,x,y,v1,v2,s11,s12,u111,u222,rising\n"), "{table}");
    let json = folder.run(&format!("{words} --json --crossings either")).expect(0).json();
    let crossings = json["crossings"].as_array().unwrap();
    assert!(crossings.len() > table.lines().count(), "both directions");
    assert!(crossings.iter().all(|one| (one["s12"].as_f64().unwrap() - 0.1).abs() < 1e-12));
    let error = folder.run("section tensor --at s13=0").expect_error(2).stderr;
    assert!(error.contains("did you mean"), "{error}");
}
