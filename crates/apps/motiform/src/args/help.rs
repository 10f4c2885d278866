//! Texts that `--help` shows below the options: examples, and the contents of the output.

pub(super) const EXAMPLES: &str = "\
Start here:
  motiform simulate tensor --preset fig5a       a zigzagging domain: numbers, figures, animation
  motiform explore                              explore the models in a browser
  motiform continue tensor --preset fig5a --along kappa2=0.3:1.6
                                                where its motion begins and ends
  motiform atlas fig4                           a plane: its motions and their boundaries
  motiform models tensor                        its equations, parameters and presets

Exit codes: 0 success; 1 finished, but some result is not as requested (a run escaped, a motion is undecided); 2 invalid input, \
or a file that cannot be written; 130 interrupted (results computed so far are kept).

The book: docs/README.md, with a tutorial; docs/options.md has every option.";

pub(super) const SIMULATE_HELP: &str = "\
Examples:
  motiform simulate tensor --preset fig5b --t-end 600
  motiform simulate tensor --preset fig4 --set kappa2=0.2 --set kappa3=0.1 --seed 7
  motiform simulate tensor --set gamma=1 --set a1=-1 --initial v1=0.1 --out run.csv
  motiform simulate cell --set length=13.2 --transient 4000 --t-end 4000
  motiform simulate tensor --preset fig2 --noise 1e-6 --t-end 5000
  motiform simulate my-study.toml --json

Noise: du = f(u) dt + ETA dW for every coordinate u accepted by --initial, with independent Wiener processes W. Without f the \
variance would be ETA^2 t: ETA has the unit of u per square root of model time. For tensor the coordinates are v1, v2 \
(velocity) and s11, s12, u111, u222 (shape), for cell c1, s1, c2, ... of phi. The law is invariant under rotations. The path \
depends on the seed and on the step of the noise: a power of 2 by the model's rates, and at most --dt-out. So another --dt-out may give \
another path of the same law.

The motion is classified from the end of the run if a short integration is conclusive (never with noise); `motiform classify` \
integrates for longer.

The output folder contains
  manifest.json        plan, hash, version, seed, outcome
  trajectory.parquet   time, position, shape, speed, turning rate
  path, series         figures, as .svg and .png; motion.png is the animation
  crossings.parquet    and the figure return-map, for studies with a return map
  fields.h5            phi(s, t) and outlines, and the figures phi and spectrum, for the cell

More: docs/recipes.md; the noise: docs/regimes.md; units: docs/units.md.";

pub(super) const SCAN_HELP: &str = "\
Examples:
  motiform scan tensor --preset fig1 --axis kappa2=0.1:1.6:64 --axis gamma=0.1:1.5:64 --samples 4
  motiform scan tensor --preset fig4 --axis kappa2=0.1,0.2,0.5 --resume
  motiform scan tensor --preset fig4 --axis kappa2=0.9:1.3:9 --samples 32 --random 0.1:0.5
  motiform scan tensor --preset fig4 --axis v1=-1:1:64 --axis s11=-1:1:64   (basins)
  motiform scan my-study.toml --shard 1/3 --out shard1

The output folder contains
  _manifest.json       plan, hash, version
  part-*.parquet       one row per cell and initial state; pandas.read_parquet(DIR) reads them all
  _diagram             the phase diagram, as .svg and .png; with one axis also _exponent
--resume continues a scan that was interrupted or killed. The results do not depend on the number of threads, shards or \
interruptions. Exit code 1: some cells are undetermined.

More: docs/recipes.md; many nodes: docs/clusters.md.";

pub(super) const CLASSIFY_HELP: &str = "\
Examples:
  motiform classify tensor --preset fig5a
  motiform classify cell --set length=21.6 --json
  motiform classify tensor --preset fig1 --set kappa2=-0.1 --set gamma=-0.04 --samples 64
  motiform classify tensor --preset fig4 --set kappa2=0.2 --set kappa3=0.1 --seed 7

Regimes, by the dynamics of the shape with rotations divided out:
  motionless, straight, circular   a stable shape: at rest, moving, moving and turning
  spinning                         a fixed shape that turns in its place
  pulsating-straight               always mirror symmetric: constant heading, changing speed
  zigzag, quasi-periodic           it returns after a period, without or with a net rotation
  rectangular                      rests near motionless shapes: a heteroclinic cycle attracts
  chaotic                          the largest Lyapunov exponent is positive by more than its error
  blow-up                          the shape grows without bound
  undetermined                     inconclusive: the output states what is missing (exit code 1)
The transient of a preset is ignored: the motion is integrated for longer and longer until the evidence is conclusive.

--samples M reports the shares of the motions with 95 % intervals, what was sampled (--random), and how many starts blow up.

More: docs/regimes.md.";

pub(super) const CONTINUE_HELP: &str = "\
Examples:
  motiform continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9 --motion zigzag --along kappa2=0.3:1.6
  motiform continue tensor --preset fig4 --set kappa3=0.3 --set kappa2=1.5 --along kappa2=0.3:3 --branches 3
  motiform continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9 --along kappa2=0.3:1.6 --curve hopf,symmetry-breaking \
    --in kappa2,kappa3=0.02:0.3
  motiform continue cell --set length=12.6 --motion circular --along length=12:13.5 --json
  motiform continue cell --set length=6 --along length=6:32 --steady --branches 40
  motiform equilibria my-study.toml --json > equilibria.json
  motiform continue --start equilibria.json:2 --along r=0:30    # the second one listed, stable or not
  motiform continue --start my-study-branches:0:17 --along s=5:15 --direction up --branch-step 0.005

The start is simulated until its motion is named, as `motiform classify` does. That motion is followed to both sides of the \
range by pseudo-arclength, through folds and whether or not it is stable. What begins at its special points is followed too, \
and so on, each branch once, mirror images not twice. With --start a point of an earlier result is the start, with its \
parameters: a point of a branch (branch and point as in points.parquet) or an equilibrium is polished by Newton's method and \
not simulated, so that it may be unstable; a state of a dataset is simulated on, but --motion motionless, straight or circular \
takes the steady motion close to it. Special points:
  fold                branch turns back               hopf                a shape begins to pulsate
  pitchfork           a symmetry of a steady shape breaks, as where straight motion begins to turn
  symmetry-breaking   left and right of a zigzag differ: it begins to rotate
  period-doubling     it repeats after two periods    torus               a second frequency begins
  homoclinic          the period grows without bound: the motion passes by a steady one
  heteroclinic        the same where it passes by several, or by one and its mirror image
Special points are solved for. stable: ranges of the parameter where small deviations die out. subcritical: what begins is unstable.

The output folder holds
  points.parquet       a row per point: parameter, motion, stability, period, speed, state, ..
  summary.json         what --json prints
  branches, period     the diagram and the periods against the parameter, as .svg, .png and .csv
  manifest.json        plan, hash, version; branches.json: from where --resume goes on
Ctrl-C keeps what was followed. The numbers do not depend on interruptions.

More: docs/continuation.md.";

pub(super) const ATLAS_HELP: &str = "\
Examples:
  motiform atlas fig4                                               the paper's Fig. 4
  motiform atlas tensor --preset fig4 --axis kappa2=0.1:1.6 --axis kappa3=0.1:1.0 --width 86mm
  motiform atlas fig1 --axis kappa2=-0.22:0.22 --axis gamma=-0.16:0.12
  motiform atlas cell --axis length=12:12.8:5 --axis g1=-0.05:0.05:5 --samples 1
  motiform atlas my-equations.toml --axis a=0:1 --axis b=-1:1 --samples 8 --resume
  motiform figure tensor-fig4-atlas --width 86mm --out paper        its figure, one column wide

This command combines three: a scan that is finer where adjacent points differ, branches along lines across the boundaries \
(`motiform continue`), and curves of bifurcations through the plane (`motiform continue --curve`). Each boundary gets the name \
of the bifurcation on it. Where none is found, the atlas says why: chaotic motion and blow-up are no branches and are found by \
sampling alone. Cells are those of a scan with the same axes, samples and seed. More --samples find coexisting motions with \
small basins, more --lines name more of the boundaries.

The output folder contains
  report.html          the map, its regions, boundaries with their bifurcations, special points
  atlas                the map, as .svg, .png and .csv
  cells.parquet        a row per cell and motion; curves.parquet: a row per point of a curve
  summary.json         what --json prints
  manifest.json        plan, hash, version; atlas.json: from where `motiform figure` draws
Ctrl-C and kills keep finished cells and lines: --resume goes on, and the numbers are the same. Exit code 1: some cells are undetermined.

More: docs/atlas.md.";

pub(super) const EQUILIBRIA_HELP: &str = "\
Examples:
  motiform equilibria tensor --preset fig4 --set kappa2=0.9 --set kappa3=0.1
  motiform equilibria cell --set length=12.6 --starts 50 --json

Newton's method from the circle and from random shapes of several sizes; then by deflation, which looks for what is not known \
yet, from sizes about those at which terms of the equations balance (a tenth of the smallest to ten times the largest), from \
symmetric shapes and from shapes between known ones, until half as many searches as --starts for each unknown (1.5 as many for \
the cell) in turn find nothing. Nothing proves that these are all.

share: of the random starts that lead there; 'deflated' and 'mirrored' (the mirror image of another one) are those that no \
start led to. unstable: number of growing directions; a motion with 0 is stable where its leading \
eigenvalue is negative. Mirror images are listed apart.

More: docs/continuation.md.";

pub(super) const SECTION_HELP: &str = "\
Examples:
  motiform section tensor --preset fig5a --at v2=0
  motiform section tensor --preset fig5b --at s12=0 --crossings either --t-end 2000 > crossings.csv
  motiform section tensor --preset fig5a --at y=1 --json

Crossings are located to round-off. A table (CSV) goes to standard output; each crossing has the time t, the place x, y, all \
coordinates of the shape, and rising (1 or 0).

More: docs/recipes.md.";

pub(super) const REPRODUCE_HELP: &str = "\
Examples:
  motiform reproduce --quick
  motiform reproduce fig4 fig5 --out paper

The output folder contains report.html (figures, parameters, and for each claim: the statement of the paper, our result, how it \
was decided, and the reason for any difference), its figures (figure-3b.svg and .png for Fig. 3(b) of the paper, figure-3.1.svg \
for what is added to Fig. 3, .csv with their numbers), and the underlying scans. The page is written again after each chapter. \
After Ctrl-C or a kill the same command goes on with the finished chapters. Exit code 1: a claim failed; one that differs or is \
not judged is no failure.

More: docs/recipes.md.";

pub(super) const VERIFY_HELP: &str = "\
Examples:
  motiform verify tensor-fig5a           the first thousand rows of the trajectory
  motiform verify tensor-fig4 --all      every cell of the scan

Checked of every result: the files that its inventory (_inventory.jsonl) lists, by their SHA-256. In
addition, of
  a dataset            the hash of its plan; rows of the trajectory, computed again; with --all the
                       crossings of its return map, too
  a scan               the digests inside its parts; the first, a middle and the last part,
                       computed again
  branches, curves     the hash of their plan; points are not computed again
  an atlas             the hash of its plan; some of its cells, computed again (with --all all
                       that were computed, once it is finished); points of its curves are not
  other results        nothing: their numbers are not computed again

Files that motiform did not write are listed, and are no fault. Exit code 0: intact; 1: not intact.

More: docs/recipes.md.";

pub(super) const LYAPUNOV_HELP: &str = "\
Examples:
  motiform lyapunov tensor --preset fig5b
  motiform lyapunov cell --set length=21.6 --count 3
  motiform lyapunov tensor --preset fig5b --samples 32
  motiform lyapunov tensor --preset fig4 --set kappa2=0.3 --set kappa3=0.1 --saddle 200

Errors are half widths of 95 % confidence intervals. The exponents that must be zero (those of the flow direction and the \
rotations) are a self-check. If an average is too short, no error is given and this is reported (exit code 1). A run that \
escapes has no exponents: use --saddle for the exponent of the chaotic saddle, with --random where small starts do not come to it.

More: docs/regimes.md.";

#[cfg(feature = "explorer")]
pub(super) const EXPLORE_HELP: &str = "\
Examples:
  motiform explore
  motiform explore --preset fig3
  motiform explore my.toml          a study file, such as one with your own equations
  motiform explore --port 8080 --no-open

The page shows a map of motions over two parameters (click on it), the moving body, its speed, spectrum, return map and \
Lyapunov exponents, and a slider for every parameter. The server is for this machine only: it listens on 127.0.0.1, its address \
contains a secret, and a page can neither read nor write files. Over ssh: ssh -L 7373:127.0.0.1:7373 HOST. The same page \
without a server, for any static host and as one file: motiform.html of a release, or `cargo xtask web` in the sources.

More: docs/explorer.md.";

pub(super) const FIGURE_HELP: &str = "\
Examples:
  motiform figure tensor-fig5a --scale 2 --to 80 --out again      other outlines, a shorter time
  motiform figure tensor-fig5a-branches --width 86mm --no-caption --out paper
                                                                  a figure as wide as a column
  motiform figure tensor-fig1-scan --style slide --title 'Motions of a domain'
  motiform figure tensor-fig5a tensor-fig5a:series tensor-fig1-scan --panels 3x1 --width 178mm --pdf --out paper
                                                                  panels (a), (b), (c) of one figure

More: docs/gallery.md.";

pub(super) const NEW_HELP: &str = "\
Examples:
  motiform new mine.toml                    a study: parameters, start, run, map, branch
  motiform new mine.toml --equations        equations of your own

Every command that takes the name of a model takes the file, too: motiform simulate mine.toml

More: docs/tutorial.md; equations: docs/equations.md.";
