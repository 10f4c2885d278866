//! HDF5 fields as h5py and as the crate itself read them.

use hdf5_pure::{AttrValue, File};
use motiform_store::{Fields, read_fields, write_fields};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Prints everything that the file holds; numbers as their bytes, since NaN is no JSON.
const DUMP: &str = r#"
import h5py, json, sys
def plain(a): return a if isinstance(a, str) else [str(v) for v in a]
def attrs(o): return {k: plain(v) for k, v in o.attrs.items()}
with h5py.File(sys.argv[1], "r") as f:
    sets = {k: {"dtype": d.dtype.str, "shape": d.shape, "bytes": d[()].tobytes().hex(), "attrs": attrs(d),
                "chunks": d.chunks, "compression": d.compression} for k, d in f.items()}
    print(json.dumps({"attrs": attrs(f), "sets": sets}))
"#;

fn fields(times: usize, arcs: usize, points: usize) -> Fields {
    let wave = |i: usize| (0.37 * i as f64).sin() / 3.0;
    let undefined = |i: usize| if i / (2 * points) == 1 { f64::NAN } else { wave(i) };
    Fields {
        times: (0..times).map(|i| 0.1 * i as f64).collect(),
        arcs: (0..arcs).map(|i| 21.6 * i as f64 / arcs as f64).collect(),
        phi: (0..times * arcs).map(wave).collect(),
        outlines: (0..times * points * 2).map(undefined).collect(),
        points,
        attributes: vec![
            ("manifest".into(), format!(r#"{{"L": 21.6, "φ": "{}"}}"#, "long ".repeat(20_000))),
            ("note".into(), String::new()),
        ],
    }
}

fn bytes(values: &[f64]) -> String {
    values.iter().flat_map(|v| v.to_le_bytes()).map(|b| format!("{b:02x}")).collect()
}

fn runs(python: &Path) -> bool {
    Command::new(python).args(["-c", "import h5py"]).output().is_ok_and(|out| out.status.success())
}

/// A Python that has h5py: the machine's, or one of a virtual environment under target/.
fn python() -> PathBuf {
    let system = PathBuf::from("python3");
    if runs(&system) {
        return system;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("h5py");
    let own = folder.join("bin/python");
    if !runs(&own) {
        // a failure of these two shows in the check below
        let _ = Command::new(&system).args(["-m", "venv"]).arg(&folder).status();
        let _ = Command::new(&own)
            .args(["-m", "pip", "install", "--quiet", "--no-compile", "h5py", "numpy"])
            .status();
    }
    assert!(runs(&own), "this test needs h5py: `pip install h5py numpy` for the python3 on the path");
    own
}

fn dump(path: &Path) -> Value {
    let out = Command::new(python()).args(["-c", DUMP]).arg(path).output().expect("python runs");
    assert!(out.status.success(), "h5py: {}", String::from_utf8_lossy(&out.stderr));
    serde_json::from_slice(&out.stdout).expect("JSON from Python")
}

#[test]
fn h5py_reads_every_value_and_attribute() {
    let folder = tempfile::tempdir().expect("a folder");
    // the second is larger than a chunk, the third has one value along each dimension
    for (times, arcs, points) in [(3, 8, 5), (700, 128, 100), (1, 1, 1)] {
        let (path, fields) = (folder.path().join("fields.h5"), fields(times, arcs, points));
        write_fields(&path, &fields).expect("a file");
        let seen = dump(&path);
        let attributes: serde_json::Map<_, _> =
            fields.attributes.iter().map(|(k, v)| (k.clone(), json!(v))).collect();
        assert_eq!(seen["attrs"], Value::Object(attributes));
        let part = |name: &str, values: &[f64], shape: Value, attrs: Value| {
            let set = &seen["sets"][name];
            assert_eq!(
                (&set["dtype"], &set["shape"], &set["attrs"]),
                (&json!("<f8"), &shape, &attrs),
                "{name}"
            );
            assert!(set["bytes"] == bytes(values), "{name} differs");
        };
        let attrs =
            |units: &str, name: &str, dims: &[&str]| json!({"units": units, "long_name": name, "dims": dims});
        part("t", &fields.times, json!([times]), attrs("model time", "time", &["t"]));
        let arc = "arc length along the boundary";
        part("s", &fields.arcs, json!([arcs]), attrs("model length", arc, &["s"]));
        let phi = "phi in the normal angle 2 pi (s + phi)/L";
        part("phi", &fields.phi, json!([times, arcs]), attrs("model length", phi, &["t", "s"]));
        let outline = "boundary, absolute coordinates x and y";
        let mut outline = attrs("model length", outline, &["t", "point", "xy"]);
        outline["undefined"] = json!("NaN where the boundary could not be closed");
        part("outline", &fields.outlines, json!([times, points, 2]), outline);
        assert_eq!(seen["sets"].as_object().map(serde_json::Map::len), Some(4));
        assert_eq!(seen["sets"]["phi"]["compression"], "gzip");
    }
}

#[test]
fn the_crate_reads_back_what_it_wrote() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, fields) = (folder.path().join("fields.h5"), fields(300, 64, 50));
    write_fields(&path, &fields).expect("a file");
    let file = File::open(&path).expect("an HDF5 file");
    let parts =
        [("t", &fields.times), ("s", &fields.arcs), ("phi", &fields.phi), ("outline", &fields.outlines)];
    for (name, values) in parts {
        let seen = file.dataset(name).and_then(|set| set.read_f64()).expect("a dataset");
        assert!(bytes(&seen) == bytes(values), "{name} differs");
    }
    let outline = file.dataset("outline").expect("a dataset");
    assert_eq!(outline.shape().expect("a shape"), [300, 50, 2]);
    let attrs = outline.attrs().expect("attributes");
    assert_eq!(attrs["units"].as_str(), Some("model length"));
    assert!(matches!(&attrs["dims"], AttrValue::VarLenStringArray(d) if d == &["t", "point", "xy"]));
    let root = file.root().attrs().expect("attributes");
    assert_eq!(root["manifest"].as_str(), Some(fields.attributes[0].1.as_str()));
}

#[test]
fn lengths_that_do_not_belong_together_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fields.h5");
    let good = || fields(3, 4, 5);
    let refused = |fields: Fields| write_fields(&path, &fields).expect_err("an error").to_string();
    let message = refused(Fields { points: 6, ..good() });
    assert!(message.contains("outline has 30 values for 3 x 6 x 2 (t, point, xy)"), "{message}");
    assert!(refused(Fields { phi: vec![0.0; 11], ..good() }).contains("phi has 11 values for 3 x 4 (t, s)"));
    assert!(refused(Fields { times: Vec::new(), ..good() }).contains("t is empty; give at least one value"));
    assert!(refused(Fields { points: usize::MAX, ..good() }).contains("outline has 30 values"));
    assert!(!path.exists());
    let nowhere = folder.path().join("nowhere").join("fields.h5");
    assert!(matches!(write_fields(&nowhere, &good()), Err(motiform_store::Error::WriteFailed { .. })));
}

#[test]
fn what_was_written_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.h5");
    let written = fields(7, 16, 12);
    write_fields(&path, &written).unwrap();
    let read = read_fields(&path).unwrap();
    assert_eq!((read.points, &read.attributes), (written.points, &written.attributes));
    let columns = |f: &Fields| [bytes(&f.times), bytes(&f.arcs), bytes(&f.phi), bytes(&f.outlines)];
    assert_eq!(columns(&read), columns(&written));
    std::fs::write(&path, "no HDF5").unwrap();
    assert!(read_fields(&path).unwrap_err().to_string().starts_with("cannot read"));
}
