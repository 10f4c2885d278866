//! The numbers that commands give, to the last bit: a change that moves one is named in CHANGELOG.md, and its digest here is renewed.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Folder;
use serde_json::Value;

/// Commands, and the digest of all numbers of what they print.
const RECORDED: [(&str, &str); 15] = [
    ("simulate tensor --preset fig2 --t-end 100", "ecd45497187fec78"),
    ("simulate tensor --preset fig3 --transient 0 --t-end 100 --stepper dopri5", "ac54ac460584352d"),
    ("simulate tensor --preset fig5b --t-end 50 --rtol 1e-12", "1e120a11c0baa448"),
    ("simulate tensor --preset fig5a --t-end 20 --stepper rk4 --step 1e-3", "a6dd78b1d5ac5804"),
    (
        "simulate tensor --preset fig4 --set kappa2=0.2 --set kappa3=0.1 --transient 0 --initial v1=8 --initial v2=1 \
         --initial s11=30 --initial u111=-20",
        "c4c3b3b11ea920d6",
    ),
    ("simulate tensor --preset fig2 --t-end 50 --noise 1e-6", "37188c27540dc3a2"),
    ("simulate cell --preset fig6b --transient 100 --t-end 20", "af259cef70666f10"),
    (
        "simulate cell --preset fig6a --transient 0 --t-end 20 --stepper etdrk4 --step 0.05",
        "7825f19e92f79d2a",
    ),
    ("classify tensor --preset fig1 --set kappa2=-0.06 --set gamma=0.02", "19750d4d56db8e45"),
    ("classify tensor --preset fig5a", "7c1202f532df06b7"),
    ("classify tensor --preset fig5b --samples 8", "38c74b21bf9588b9"),
    ("classify cell --set length=29.2", "32f57218504d59f2"),
    ("lyapunov tensor --preset fig5b --t-end 300", "5c73329ab624b31c"),
    ("lyapunov tensor --preset fig5b --t-end 300 --samples 9", "c206c76add686dce"),
    ("lyapunov cell --set length=21.75 --transient 200 --t-end 200", "d3d2570f233ef44f"),
];

/// FNV-1a over names and bits of all numbers, in their order; what the program is and how it was called is left out.
fn digest(value: &Value, mut hash: u64) -> u64 {
    let mut take = |bytes: &[u8]| {
        for byte in bytes {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    match value {
        Value::Number(number) => take(&number.as_f64().unwrap().to_bits().to_le_bytes()),
        Value::Array(items) => return items.iter().fold(hash, |hash, item| digest(item, hash)),
        Value::Object(fields) => {
            let fields = fields.iter().filter(|(name, _)| *name != "manifest");
            return fields.fold(hash, |hash, (_, field)| digest(field, hash));
        }
        _ => {}
    }
    hash
}

#[test]
fn numbers_are_those_recorded() {
    let folder = Folder::new();
    let moved: Vec<String> = RECORDED
        .iter()
        .filter_map(|(command, recorded)| {
            let done = folder.run(&format!("{command} --json"));
            let object: Value = serde_json::from_str(&done.stdout).unwrap();
            let found = format!("{:016x}", digest(&object, 0xcbf2_9ce4_8422_2325));
            (found != *recorded).then(|| format!("{command}: {found}"))
        })
        .collect();
    assert!(moved.is_empty(), "numbers moved:\n{}", moved.join("\n"));
}
