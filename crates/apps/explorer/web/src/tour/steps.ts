/** The steps of the tour: a place, what is seen there, and one thing to do. */

export interface Step {
  title: string;
  /** What is seen. */
  seen: string;
  /** What to do, and the element to do it with. */
  todo: string;
  target: string;
  /** The address of the place. */
  place: string;
}

export const STEPS: Step[] = [
  {
    title: "Fig. 1: the motions of a body with velocity and ellipse",
    seen: "Each point of the map stands for two parameters of the model, and its colour for the motion that a body settles on there. The lines between the regions are computed from formulas.",
    todo: "Click into the map, or move with the arrow keys there: the body takes these parameters and keeps its state.",
    target: "#map",
    place: "preset=fig1",
  },
  {
    title: "Fig. 2: rectangular motion",
    seen: "The body runs straight, rests, and turns by 90 degrees. It rests near shapes that are saddles; without noise each rest is longer than the one before.",
    todo: "Raise the noise a little: the rests become shorter, and their lengths random.",
    target: "#noise",
    place: "preset=fig2",
  },
  {
    title: "Fig. 3: quasi-periodic motion",
    seen: "The path is a rosette that never closes. Where it rises through the height of its centre, each x plotted against the one before lies on a closed curve: the return map.",
    todo: "Compute 300 returns at once with the button of the return map.",
    target: "#returns-ahead",
    place: "preset=fig3",
  },
  {
    title: "Fig. 4: velocity, ellipse and triangle",
    seen: "With a three-fold deformation there are zigzags and chaos, too. Black: the shape becomes infinite within a finite time.",
    todo: "Move the slider of \u03ba\u2083 slowly to the left, and watch the motion change where the map changes its colour.",
    target: '[data-parameter="kappa3"] input[type="range"]',
    place: "preset=fig4&kappa2=0.9&kappa3=0.4",
  },
  {
    title: "Fig. 5: zigzag and chaos",
    seen: "A zigzag is an attracting motion: a body that is deformed returns to it. In Fig. 5(b), at \u03ba\u2082 = 0.5, nearby starts move apart instead: the motion is chaotic.",
    todo: "Drag the outline of the body, or give it a kick (key k), and let it go.",
    target: "#body",
    place: "preset=fig5a",
  },
  {
    title: "Fig. 6: active cells",
    seen: "Here the body is a closed boundary of fixed length that deforms by itself; it moves as a result of its deformation, and by much less than its size. The inset shows the path enlarged.",
    todo: "Change the length L of the boundary, the axis of the map.",
    target: '[data-parameter="length"] input[type="range"]',
    place: "preset=fig6b",
  },
  {
    title: "Where the zigzag begins",
    seen: "The paper shows what simulations settle on. Followed along \u03ba\u2082, stable or not, the zigzag turns out not to begin at straight motion: the two only meet where its period becomes infinite, at \u03ba\u2082 = 1.344.",
    todo: "Choose Branches above the map, then Follow; click a point of a branch to place the body on that motion.",
    target: "#show-branches",
    place: "preset=fig4&kappa2=0.9&kappa3=0.1&x=kappa2:0.3:1.6&y=kappa3:0.05:0.4",
  },
  {
    title: "Pulsating straight motion",
    seen: "In a narrow region of Fig. 1, beside its stability limit, the body moves along a line while its speed and shape repeat: a motion that the paper does not name.",
    todo: "Zoom into the map about the ring with the wheel, two fingers, or the key + to see the region.",
    target: "#map",
    place: "preset=fig1&kappa2=-0.02&gamma=-0.045&x=kappa2:-0.06:0.02&y=gamma:-0.07:-0.01",
  },
  {
    title: "Blow-up",
    seen: "For some starts the equations of Fig. 4 have no solution beyond a finite time t*: the shape becomes infinite. The program locates t*; an integration with fixed steps would continue with meaningless numbers.",
    todo: "Press Restart, then deform the body by hand: which deformations grow without bound, and which decay?",
    target: "#restart",
    place: "preset=fig4&kappa2=0.2&kappa3=0.1&at=0,0&state=8,1,30,0,-20,0&speed=1",
  },
];
