//! Damaged command lines are parsed or refused, in the process: `MOTIFORM_FUZZ=200000 cargo test --release -p motiform fuzz::` tries more.

use super::Arguments;
use clap::Parser;
#[path = "../../../../lab/lab/tests/all/common/mutate.rs"]
mod mutate;
use mutate::{each, in_turn};

/// Together they have most of the options.
const LINES: [&str; 21] = [
    "models tensor --json",
    "simulate tensor --preset fig5a --set kappa2=0.5 --initial v1=0.1 --t-end 100 --transient 5 --dt-out 0.1 --out run.csv --force",
    "simulate cell --seed 7 --rtol 1e-9 --atol 1e-12 --stepper krogstad4 --max-steps 100 --noise 1e-3 --format csv --no-figures",
    "scan tensor --preset fig1 --axis kappa2=-0.2:0.2:40 --axis gamma=0.1,0.2 --samples 3 --budget 300 --shard 2/8 --out s --resume",
    "merge a b c --out d --force",
    "classify tensor --set gamma=0.5 --budget 100 --samples 8 --random 0.01:1 --perturb 0 --json",
    "lyapunov tensor --preset fig5b --count 3 --transient 10 --t-end 100 --saddle 4",
    "continue tensor --preset fig5a --along kappa2=0.3:1.6 --branches 3 --points 50 --motion straight --out b",
    "continue tensor --preset fig5a --curve hopf --in kappa2,gamma=0:1 --out curves",
    "atlas tensor --preset fig4 --axis kappa2=0.1:1.6 --axis kappa3=0.1:1:9 --samples 2 --lines 3 --branches 2 --steady --out a",
    "equilibria cell --set length=14 --starts 50 --json",
    "section tensor --preset fig5a --at s12=0 --crossings rising --t-end 100",
    "lifetimes tensor --preset fig5b --axis kappa2=0.4:0.5:3 --samples 20 --until 1000 --out lives --threads 2",
    "statistics tensor --preset fig5b --bodies 16 --t-end 100 --noise 0.05 --threshold 2 --out st",
    "observe cells.csv --pixel-size 0.5 --interval 2 --cell a --write-outlines again.csv --no-report --json",
    "fit cells.csv --order 3 --modes 3 --draws 10 --seed 1 --together --threads 2 --resume --out f",
    "reproduce fig2 fig4 --quick --out R --threads 4 --json",
    "check study.toml --json",
    "verify run --all --json",
    "figure run scan --width 300 --title x --no-caption --radius 3 --force",
    "completions bash",
];

#[test]
fn command_lines() {
    let read = |bytes: &[u8]| {
        let line = String::from_utf8_lossy(bytes);
        let Err(refused) =
            Arguments::try_parse_from(std::iter::once("motiform").chain(line.split_whitespace()))
        else {
            return true;
        };
        let said = refused.to_string();
        assert!(matches!(refused.exit_code(), 0 | 2) && !said.is_empty(), "{line:?}: {said}");
        assert!(said.len() < 20_000 + 8 * line.len(), "{line:?}: {} bytes", said.len());
        false
    };
    let undamaged = LINES.iter().filter(|line| read(line.as_bytes())).count();
    assert!(undamaged > 14, "{undamaged}");
    each("command lines", (40, 5000), in_turn(&LINES), read);
}
