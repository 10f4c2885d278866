/** Play, speed, noise, trail and follow: what one does to the body, also by keys. */

import { byId, setText, takesKeys } from "./dom";
import { pretty } from "./numbers";
import { behind, units } from "./units";

/** What the controls do. */
export interface Actions {
  play(playing: boolean): void;
  restart(): void;
  /** A kick by this part of the size of the shape. */
  kick(strength: number): void;
  noise(amplitude: number): void;
  speed(speed: number): void;
  trail(time: number): void;
  follow(follow: boolean): void;
}

/** The largest amplitude of noise that the page offers. */
export const MOST_NOISE = 1;
/** The noise slider: 0, then ten decades up to 1. */
const NOISE_DECADES = 10;
/** Strengths of kicks, relative to the size of the shape. */
const KICKS: [number, number] = [0.01, 2];
/** The trail is so many seconds of the opening speed. */
const TRAIL = { least: 1, usual: 15, most: 80 };

export class Controls {
  private readonly playButton = byId<HTMLButtonElement>("play");
  private readonly followButton = byId<HTMLButtonElement>("follow");
  private readonly speed = new LogDial("speed", (value) => `${pretty(value, 2)}${behind(units().time)}/s`);
  private readonly trail = new LogDial("trail", (value) => `${pretty(value, 2)}${behind(units().time)}`);
  private readonly strength = new LogDial("strength", (value) => pretty(value, 2));
  private kickBy = 0.2;
  private readonly noise = byId<HTMLInputElement>("noise");

  constructor(private readonly actions: Actions) {
    this.playButton.addEventListener("click", () => this.toggle());
    this.followButton.addEventListener("click", () => actions.follow(this.followButton.getAttribute("aria-pressed") !== "true"));
    byId("restart").addEventListener("click", () => actions.restart());
    byId("ended-restart").addEventListener("click", () => actions.restart());
    byId("kick").addEventListener("click", () => this.kick());
    this.strength.changed = (value) => (this.kickBy = value);
    this.strength.show(this.kickBy, KICKS);
    this.speed.changed = (value) => actions.speed(value);
    this.trail.changed = (value) => actions.trail(value);
    this.noise.addEventListener("input", () => actions.noise(this.amplitude()));
    document.addEventListener("keydown", (event) => this.key(event));
  }

  setPlaying(playing: boolean): void {
    this.playButton.setAttribute("aria-pressed", String(playing));
    const label = playing ? "Pause" : "Play";
    this.playButton.setAttribute("aria-label", label);
    this.playButton.title = `${label} (space)`;
  }

  setFollow(follow: boolean): void {
    this.followButton.setAttribute("aria-pressed", String(follow));
  }

  /** The bounds and the value of the speed; the trail is measured by the opening speed. */
  setSpeed(speed: number, bounds: [number, number]): void {
    this.speed.show(speed, bounds);
  }

  /** The speed within the same bounds. */
  turnSpeed(speed: number): void {
    this.speed.turn(speed);
  }

  setTrail(opening: number): void {
    this.trail.show(TRAIL.usual * opening, [TRAIL.least * opening, TRAIL.most * opening]);
    this.actions.trail(TRAIL.usual * opening);
  }

  setNoise(amplitude: number): void {
    if (amplitude !== this.amplitude()) this.noise.value = amplitude > 0 ? String(100 + (100 / NOISE_DECADES) * Math.log10(amplitude)) : "0";
    this.noise.setAttribute("aria-valuetext", pretty(amplitude, 2));
    setText(byId("noise-value"), pretty(amplitude, 2));
  }

  private amplitude(): number {
    const value = this.noise.valueAsNumber;
    return value === 0 ? 0 : Number((10 ** ((value - 100) * (NOISE_DECADES / 100))).toPrecision(2));
  }

  private kick(): void {
    this.actions.kick(this.kickBy);
  }

  private toggle(): void {
    this.actions.play(this.playButton.getAttribute("aria-pressed") !== "true");
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || takesKeys(event.target)) return;
    const actions: Record<string, () => void> = {
      " ": () => this.toggle(),
      r: () => this.actions.restart(),
      k: () => this.kick(),
      f: () => this.followButton.click(),
    };
    const act = actions[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

/** A slider over decades with its value beside it. */
class LogDial {
  changed: (value: number) => void = () => undefined;
  private bounds: [number, number] = [1, 10];
  private readonly input: HTMLInputElement;
  private readonly output: HTMLElement;

  constructor(id: string, private readonly label: (value: number) => string) {
    this.input = byId<HTMLInputElement>(id);
    this.output = byId(`${id}-value`);
    this.input.addEventListener("input", () => {
      const [low, high] = this.bounds;
      const value = Number((low * (high / low) ** (this.input.valueAsNumber / 1000)).toPrecision(3));
      this.say(value);
      this.changed(value);
    });
  }

  show(value: number, bounds: [number, number]): void {
    this.bounds = bounds;
    this.turn(value);
  }

  turn(value: number): void {
    const { bounds } = this;
    this.input.value = String(1000 * Math.log(value / bounds[0]) / Math.log(bounds[1] / bounds[0]));
    this.say(value);
  }

  private say(value: number): void {
    setText(this.output, this.label(value));
    this.input.setAttribute("aria-valuetext", this.label(value));
  }
}
