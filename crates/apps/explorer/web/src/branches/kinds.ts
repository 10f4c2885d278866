/** The kinds of special points: what they are called, their markers (those of the figures), and what they mean. */

interface Kind {
  label: string;
  glyph: string;
  meaning: string;
}

const KINDS: Record<string, Kind> = {
  fold: { label: "fold", glyph: "Star", meaning: "The branch turns back: two motions meet, and beyond there is neither." },
  pitchfork: { label: "pitchfork", glyph: "Diamond", meaning: "Two motions with less symmetry begin, images of each other." },
  "branch-point": { label: "branch point", glyph: "DownTriangle", meaning: "Another branch crosses this one." },
  continuum: { label: "continuum", glyph: "Plus", meaning: "A whole family of motions exists at this one value: the equations regain a symmetry there, as where a field vanishes." },
  hopf: { label: "Hopf", glyph: "Disc", meaning: "An oscillation of the shape begins: a pair of eigenvalues crosses the imaginary axis." },
  "period-doubling": { label: "period doubling", glyph: "Triangle", meaning: "An orbit of twice the period begins: a multiplier passes \u22121." },
  "symmetry-breaking": { label: "symmetry breaking", glyph: "Square", meaning: "Zigzags begin whose left and right legs differ: the multiplier over half the period passes \u22121." },
  torus: { label: "torus", glyph: "Ring", meaning: "A second frequency begins: a pair of complex multipliers crosses the unit circle." },
  unresolved: { label: "not located", glyph: "Question", meaning: "Something changes between two points of the branch and could not be located." },
  homoclinic: { label: "homoclinic", glyph: "Cross", meaning: "The period becomes infinite: the orbit comes ever closer to an unstable steady motion, and leaves it again." },
  connection: { label: "connection", glyph: "Zigzag", meaning: "The period becomes infinite: the orbit comes ever closer to unstable steady motions. It is not seen how these are related." },
  heteroclinic: { label: "heteroclinic", glyph: "Zigzag", meaning: "The period becomes infinite: the orbit comes ever closer to two or more unstable steady motions, one after the other." },
};

export function kindOf(name: string): Kind {
  return KINDS[name] ?? { label: name, glyph: "Question", meaning: "" };
}

/** What is said of the onset of what begins at a special point. */
export const CRITICALITY: Record<string, string> = {
  supercritical: "supercritical: what begins is stable",
  subcritical: "subcritical: what begins is unstable",
};
