/** What the page and the server say to each other, as JSON; see PROTOCOL.md. Made from `src/protocol`: do not edit. */

/** Bytes of the longest message of the page. */
export const LONGEST = 32768;

/** Named numbers. */
export type Values = Record<string, number>;

/** Where the return map is taken: at the maxima of the speed, or where the path crosses a line. */
export type Section = "speed" | "path";

/** Where the bodies of a swarm begin: at random shapes; near the shape of the body; at that shape, each with noise of its own. */
export type SwarmStart = "starts" | "near" | "noises";

export interface Parameter {
  name: string;
  symbol: string;
  default: number;
  range: [number, number];
  allowed: [number, number];
  equation: string;
  meaning: string;
  whole: boolean;
}

export interface Coordinate {
  name: string;
  meaning: string;
}

export interface Observable {
  name: string;
  symbol: string;
  meaning: string;
}

/** An axis of the map: a parameter or a coordinate of the start, and the part of it that is shown. */
export interface Axis {
  name: string;
  low: number;
  high: number;
}

/** The part of parameter space that the map shows; without `y` it is a strip. */
export interface Plane {
  x: Axis;
  y: Axis | null;
}

export interface Model {
  name: string;
  title: string;
  equations: string;
  source: string;
  budget: number;
  look: number;
  parameters: Parameter[];
  coordinates: Coordinate[];
  observables: Observable[];
  plane: Plane;
  noise: number;
  editable: boolean;
}

export interface Preset {
  name: string;
  model: string;
  title: string;
  about: string;
  free: string[];
  parameters: Values;
  speed: number;
  plane: Plane | null;
  section: Section;
}

export interface Regime {
  name: string;
  words: string;
  colour: string;
  area: string;
  tint: string;
  glyph: string;
  hand: string | null;
  meaning: string;
}

/** Models, presets and regimes, in the order of lists and legends; then the regimes by the sense in which bodies turn. */
export interface Registry {
  models: Model[];
  presets: Preset[];
  regimes: Regime[];
  turning: Regime[];
}

/** A tracked cell, and the model that was fitted to it: time from the first frame, x, y, R0, then the parts of z2, z3, .. of each frame. */
export interface Tracked {
  model: string;
  name: string;
  length: string;
  time: string;
  frames: number[][];
}

/** A running Lyapunov exponent with the half width of its 95 % interval. */
export interface Exponent {
  value: number;
  error: number | null;
}

export interface Spectrum {
  name: string;
  symbol: string;
  power: number[];
}

export interface Returns {
  section: Section;
  label: string;
  y: number | null;
  points: [number, number][];
}

/** The centres of cells along one axis: `first + i step`. */
export interface Grid {
  name: string;
  first: number;
  step: number;
  count: number;
}

/** A line of the theory in the plane of the map. */
export interface Line {
  label: string;
  style: LineStyle;
  points: [number, number][];
}

/** A special point, and where it is on its branch; `leads`: the branch that begins or lies there. `speed`: of a connection, where the branch ends beyond its last point. */
export interface SpecialPoint {
  branch: number;
  point: number;
  kind: string;
  parameter: number;
  speed: number | null;
  period: number | null;
  criticality: string | null;
  breaks: string | null;
  leads: number | null;
}

/** Dashes of a line of the theory. */
export type LineStyle = "solid" | "dashed" | "dotted" | "dash-dotted" | "long-dashed";

/** The first message; `restart` is the command that starts this server again. */
export interface Hello {
  is: "hello";
  version: string;
  restart: string;
  registry: Registry;
  tracked: Tracked | null;
}

/** A new body. */
export interface Begun {
  is: "begun";
  revision: number;
  model: string;
  preset: string | null;
  title: string;
  about: string;
  parameters: Values;
  noise: number;
  sample: number;
  speed: number;
  speeds: [number, number];
  observables: Observable[];
}

/** The motion was changed: these parameters and this noise from now on. */
export interface Changed {
  is: "changed";
  revision: number;
  parameters: Values;
  noise: number;
}

/** The motion is being named. */
export interface NamingBegun {
  is: "naming";
  revision: number;
}

/** The name of the motion, with the numbers that are defined. */
export interface Named {
  is: "named";
  revision: number;
  regime: string;
  why: string;
  numbers: Values;
}

/** The largest exponents, averaged so far. */
export interface Exponents {
  is: "exponents";
  revision: number;
  time: number;
  exponents: Exponent[];
  done: boolean;
}

/** Power spectra and the return map of the motion since the last change. */
export interface Strips {
  is: "strips";
  revision: number;
  samples: number;
  frequencies: number[];
  spectra: Spectrum[];
  returns: Returns;
}

/** The return map of the motion from now on, up to this time; `complete`: as many returns as were asked for. */
export interface ReturnsAhead {
  is: "returns";
  revision: number;
  time: number;
  complete: boolean;
  returns: Returns;
}

/** The motion that a body of the swarm ends in. */
export interface Member {
  is: "member";
  revision: number;
  body: number;
  regime: string;
}

/** A map begins; its cells follow. */
export interface MapStart {
  is: "map";
  epoch: number;
  x: Grid;
  y: Grid | null;
  lines: Line[];
}

/** Progress of a map: cells, and cells per second. */
export interface Progress {
  is: "progress";
  epoch: number;
  done: number;
  total: number;
  rate: number;
}

/** A map is complete. */
export interface Mapped {
  is: "mapped";
  epoch: number;
  cells: number;
  computed: number;
  seconds: number;
}

/** The verdict on a cell; no regime and no words where it is not computed yet. */
export interface Evidence {
  is: "evidence";
  epoch: number;
  cell: [number, number];
  parameters: Values;
  regime: string | null;
  why: string;
  numbers: Values | null;
}

/** Branches begin: along this parameter, the others as they are. */
export interface BranchesStart {
  is: "branches";
  epoch: number;
  along: Axis;
  parameters: Values;
}

/** A branch, point by point; `between[k]` and `stable[k]`: the motion, and its stability, between the points k and k + 1. `unstable` and `neutral`: the numbers of growth rates above 0, and of those that are 0 within their errors. A period of 0: none. */
export interface Branch {
  is: "branch";
  epoch: number;
  branch: number;
  origin: [number, number] | null;
  parameter: number[];
  speed: number[];
  period: number[];
  motion: string[];
  unstable: number[];
  neutral: number[];
  between: string[];
  stable: boolean[];
}

/** The special points of all branches so far. */
export interface Specials {
  is: "specials";
  epoch: number;
  points: SpecialPoint[];
}

/** Progress of the branches, 0 to 1, and the one under way. */
export interface Following {
  is: "following";
  epoch: number;
  done: number;
  branch: number;
}

/** No more branches: `left` points were left at which more may begin; `why` says what made it impossible. */
export interface Followed {
  is: "followed";
  epoch: number;
  branches: number;
  left: number;
  seconds: number;
  why: string | null;
}

/** The orbit that the body was placed on at time `t`, over one period, relative to `position`; the next one is turned by `rotation`. */
export interface Orbit {
  is: "orbit";
  revision: number;
  parameters: Values;
  unstable: number;
  t: number;
  position: [number, number];
  time: number;
  rotation: number;
  points: [number, number][];
}

/** The body goes on no further until the next change. */
export interface Ended {
  is: "ended";
  revision: number;
  outcome: string;
  text: string;
}

/** The present study as a command and in Python. */
export interface Share {
  is: "share";
  command: string;
  python: string;
}

/** The present study as a study file with its equations. */
export interface Source {
  is: "source";
  text: string;
}

/** The text of a page became this model. */
export interface Defined {
  is: "defined";
  model: Model;
}

/** The text of a page is no study: what is wrong, and where (line and column from 1, `length` characters). */
export interface Mistake {
  is: "mistake";
  line: number;
  column: number;
  length: number;
  problem: string;
}

/** A message that cannot be answered. */
export interface Refused {
  is: "refused";
  id: number | null;
  why: string;
}

/** Everything the server says as text. */
export type Answer =
  | Hello
  | Begun
  | Changed
  | NamingBegun
  | Named
  | Exponents
  | Strips
  | ReturnsAhead
  | Member
  | MapStart
  | Progress
  | Mapped
  | Evidence
  | BranchesStart
  | Branch
  | Specials
  | Following
  | Followed
  | Orbit
  | Ended
  | Share
  | Source
  | Defined
  | Mistake
  | Refused;

/** Everything the page says. */
export type Wish =
  | { do: "begin"; model: string; preset: string | null; parameters: Values; state: number[] | null; position: [number, number] | null; t: number; noise: number | null; seed: number }
  | { do: "set"; parameters: Values }
  | { do: "noise"; amplitude: number }
  | { do: "advance"; dt: number }
  | { do: "strips"; section: Section; y: number | null }
  | { do: "map"; epoch: number; x: Axis; y: Axis | null; count: number }
  | { do: "evidence"; epoch: number; cell: [number, number] }
  | { do: "follow"; epoch: number; along: Axis; branches: number }
  | { do: "place"; epoch: number; branch: number; point: number }
  | { do: "start"; coordinates: Values }
  | { do: "kick"; strength: number }
  | { do: "put"; parameters: Values; state: number[] | null; position: [number, number] | null; velocity: [number, number] | null; t: number | null; noise: number | null }
  | { do: "pull"; state: number[]; to: [number, number] }
  | { do: "returns"; section: Section; y: number | null; count: number }
  | { do: "swarm"; bodies: number; from: SwarmStart; spread: number }
  | { do: "export"; id: number; what: string; section: Section; y: number | null }
  | { do: "define"; text: string }
  | { do: "restart" }
  | { do: "unmap" }
  | { do: "unfollow" }
  | { do: "source" }
  | { do: "share" };

/** A new body; `null` leaves the start to the preset. */
export type Begin = Extract<Wish, { do: "begin" }>;
