/** Brings the parts together: what the server says goes to the panels, what the reader does goes to the server. */

import { read, write, type Place } from "./address";
import type { Frame } from "./binary";
import { BodyPanel } from "./body/panel";
import { showName } from "./body/naming";
import { Connection } from "./connection";
import { Controls } from "./controls";
import { byId, setText, throttle } from "./dom";
import { History } from "./history";
import { expose } from "./handle";
import { MapPanel } from "./map/panel";
import { ParameterPanel } from "./parameters";
import { PresetBar } from "./presets";
import type { Answer, Begun, Hello, Named, Plane, Refused, Regime, Values, Wish } from "./protocol";
import { Session } from "./session";
import { ShareMenu } from "./share";
import { showConnection } from "./status";
import { StripPanels } from "./strips/panels";
import { currentInks, onTheme } from "./theme";
import { toast } from "./toasts";

/** Longest step of model time, in seconds of the wall. */
const LONGEST = 0.1;
const ADDRESS_GAP = 1000;
const ADDRESS_WHILE_MOVING = 3000;

export class App {
  private session: Session | null = null;
  private playing = true;
  private ended = false;
  private regime: Regime | null = null;
  /** Whether an `advance` is under way. */
  private waiting = false;
  private asked = 0;
  private drawn = 0;
  private written = 0;
  /** What the last `begin` asked for; `null` once the server agreed. */
  private beginning: Place | null = null;
  frames = 0;

  private readonly history = new History();
  private readonly body: BodyPanel;
  private readonly map: MapPanel;
  private readonly strips: StripPanels;
  private readonly parameters = new ParameterPanel((name, value) => this.choose({ [name]: value }));
  private readonly presets = new PresetBar((name) => this.openPreset(name), (name) => this.openModel(name));
  private readonly controls: Controls;
  private readonly share: ShareMenu;
  private readonly connection: Connection;
  private readonly remember = throttle(ADDRESS_GAP, () => this.writeAddress());

  constructor() {
    this.body = new BodyPanel(this.history, (follow) => this.controls.setFollow(follow));
    this.strips = new StripPanels(this.history, (wish) => this.send(wish), (time) => this.body.point(time), () => this.remember());
    this.map = new MapPanel({
      send: (wish) => this.send(wish),
      regimes: () => this.session?.registry.regimes ?? [],
      model: () => this.need().model,
      parameters: () => this.session?.parameters ?? {},
      choose: (values) => this.choose(values),
      moved: () => this.windowMoved(),
    });
    this.controls = new Controls({
      play: (playing) => this.play(playing),
      restart: () => this.act({ do: "restart" }),
      kick: () => this.act({ do: "kick" }),
      noise: (amplitude) => this.act({ do: "noise", amplitude }),
      speed: (speed) => this.setSpeed(speed),
      trail: (time) => this.body.setTrail(time),
      follow: (follow) => this.body.setFollow(follow),
    });
    this.share = new ShareMenu({
      send: (wish) => this.send(wish),
      connected: () => this.connection.open,
      section: () => this.strips.section(),
      link: () => this.link(),
    });
    this.connection = new Connection({
      answer: (answer) => this.hear(answer),
      frame: (frame) => this.take(frame),
      cells: (cells) => this.map.cells(cells),
      file: (file) => this.share.take(file),
      open: (open) => this.opened(open),
    });
    this.watch();
    requestAnimationFrame((now) => this.tick(now));
  }

  private watch(): void {
    onTheme(() => {
      this.map?.touch();
      this.paintRegime();
      this.strips?.touch();
    });
    document.addEventListener("visibilitychange", () => this.writeAddress());
    window.addEventListener("hashchange", () => this.openAddress());
    expose({
      frames: () => this.frames,
      frame: () => this.body.last(),
      map: this.map,
    });
  }

  private need(): Session {
    if (!this.session) throw new Error("the server has not said hello yet");
    return this.session;
  }

  private send(wish: Wish): void {
    this.connection.send(wish);
  }

  // ---- what the server says

  private opened(open: boolean): void {
    showConnection(open);
    this.waiting = false;
    if (!open) this.share.drop();
  }

  private hear(answer: Answer): void {
    switch (answer.is) {
      case "hello":
        return this.hello(answer);
      case "begun":
        return this.begun(answer);
      case "changed":
        return this.changed(answer.revision, () => this.session?.agreed(answer));
      case "naming":
        return this.current(answer.revision) ? this.name(null, "") : undefined;
      case "named":
        return this.current(answer.revision) ? this.named(answer) : undefined;
      case "exponents":
        return this.current(answer.revision) ? this.strips.exponents(answer) : undefined;
      case "strips":
        return this.strips.take(answer, this.current(answer.revision));
      case "map":
        return this.map.started(answer);
      case "progress":
        return this.map.progress(answer);
      case "mapped":
        return this.map.mapped(answer);
      case "evidence":
        return this.map.evidence(answer);
      case "ended":
        return this.current(answer.revision) ? this.end(answer.text) : undefined;
      case "share":
        return this.share.show(answer);
      case "refused":
        return this.refused(answer);
    }
  }

  private current(revision: number): boolean {
    return revision === this.session?.revision;
  }

  /** The first greeting opens the address; after a loss of the connection the body goes on where it was. */
  private hello({ registry, restart, version }: Hello): void {
    setText(byId("banner-command"), restart);
    byId("connection").title = `motiform ${version}`;
    const place = this.session && this.body.last() ? this.place() : null;
    this.session = new Session(registry);
    this.presets.fill(registry);
    if (place) this.open(place);
    else this.openAddress();
  }

  private begun(begun: Begun): void {
    const session = this.need();
    const place = this.beginning;
    this.beginning = null;
    session.begun(begun);
    session.speed = place?.speed ?? begun.speed;
    setText(byId("about"), begun.about);
    document.title = `${begun.title} \u2013 motiform`;
    this.presets.show(session.model.name, begun.preset);
    this.parameters.begin(session.model, session.preset, session.base);
    this.parameters.show(session.parameters);
    this.controls.setSpeed(session.speed, begun.speeds);
    this.controls.setTrail(begun.speed);
    this.controls.setNoise(begun.noise);
    this.history.clear();
    this.body.begin();
    this.strips.begin(session.model.observables, place?.section ?? session.preset?.section ?? "speed", place?.section ? place.y : session.preset?.y ?? null);
    const home = session.preset?.plane ?? session.model.plane;
    this.map.begin(place?.plane ?? home, home);
    this.markAxes();
    this.renew();
    this.remember();
  }

  private changed(_revision: number, agree: () => void): void {
    agree();
    const session = this.need();
    this.parameters.show(session.parameters);
    this.controls.setNoise(session.noise);
    this.map.touch();
    this.renew();
    this.remember();
  }

  /** The motion is another one: no name, no exponents, and the body may move again. */
  private renew(): void {
    this.ended = false;
    byId("ended").hidden = true;
    this.name(null, "");
    this.strips.renew();
    if (!this.playing) this.send({ do: "advance", dt: 0 });
  }

  private named({ regime, why }: Named): void {
    this.name(this.need().registry.regimes.find((one) => one.name === regime) ?? null, why);
  }

  private name(regime: Regime | null, why: string): void {
    this.regime = regime;
    showName(regime, why);
    this.paintRegime();
  }

  /** The body takes the colour of its regime; black is invisible upon dark. */
  private paintRegime(): void {
    const inks = currentInks();
    const colour = this.regime?.colour ?? "#888888";
    this.body?.setColour(inks.dark && colour === "#000000" ? inks.ink : colour);
  }

  private end(text: string): void {
    this.ended = true;
    setText(byId("ended-text"), text);
    byId("ended").hidden = false;
  }

  private refused({ id, why }: Refused): void {
    if (id !== null && this.share.refuse(id, why)) return;
    if (this.beginning) return this.beginLess(this.beginning, why);
    const names = this.session?.refused(why) ?? [];
    if (!this.parameters.refuse(names, why)) toast(why);
    if (this.session) this.parameters.show(this.session.parameters);
    this.map.touch();
  }

  /** A beginning that was refused is tried with less: without state, then without changes, then from the start. */
  private beginLess(place: Place, why: string): void {
    this.beginning = null;
    toast(why);
    if (place.state) this.open({ ...place, state: null, position: null, t: 0 });
    else if (Object.keys(place.parameters).length) this.open({ ...place, parameters: {} });
  }

  private take(frame: Frame): void {
    this.waiting = false;
    this.frames++;
    if (frame.revision < this.need().revision) return;
    this.history.take(frame);
    this.body.take(frame);
  }

  // ---- what the reader does

  private openPreset(name: string): void {
    const preset = this.need().registry.presets.find((one) => one.name === name);
    if (preset) this.open(fresh(preset.model, name, this.playing));
  }

  private openModel(name: string): void {
    this.open(fresh(name, null, this.playing));
  }

  private openAddress(): void {
    const { place, notes } = read(location.hash, this.need().registry);
    if (notes.length) toast(`Left aside in the address: ${notes.join(", ")}`);
    this.playing = place.playing;
    this.controls.setPlaying(this.playing);
    this.open(place);
  }

  private open(place: Place): void {
    const session = this.need();
    const { model, preset, parameters, state, position, t, noise } = place;
    session.choose(model, preset, parameters);
    this.beginning = place;
    this.send({ do: "begin", model, preset, parameters, state, position, t, noise, seed: 1 });
  }

  /** New values: sent with the next frame, one message however many there are. */
  private choose(values: Values): void {
    const { session } = this;
    if (!session) return;
    session.want(values);
    this.parameters.show(session.parameters);
    this.map.touch();
    if (Object.keys(values).some((name) => !this.map.isAxis(name))) this.mapStale = true;
    this.remember();
  }

  private mapStale = false;

  private flush(): void {
    const values = this.session?.take();
    if (!values) return;
    this.send({ do: "set", parameters: values });
    if (this.mapStale) this.map.renew();
    this.mapStale = false;
  }

  private act(wish: Wish): void {
    this.send(wish);
  }

  private play(playing: boolean): void {
    this.playing = playing;
    this.asked = performance.now();
    this.controls.setPlaying(playing);
    this.writeAddress();
  }

  private setSpeed(speed: number): void {
    this.need().speed = speed;
    this.remember();
  }

  private windowMoved(): void {
    this.markAxes();
    this.remember();
  }

  private markAxes(): void {
    const plane: Plane | null = this.map.current();
    this.parameters.markAxes(plane?.x.name ?? null, plane?.y?.name ?? null);
  }

  // ---- the address

  private place(): Place {
    const session = this.need();
    const frame = this.body.last();
    return {
      model: session.model.name,
      preset: session.preset?.name ?? null,
      parameters: session.changed(),
      plane: this.map.current(),
      speed: session.speed,
      noise: session.noise,
      ...this.strips.section(),
      playing: this.playing,
      t: frame?.t ?? 0,
      position: frame && [frame.x, frame.y],
      state: frame && [...frame.state],
    };
  }

  private link(): string {
    return `${location.href.replace(/#.*/, "")}${this.session ? write(this.place()) : ""}`;
  }

  private writeAddress(): void {
    if (!this.session || this.beginning) return;
    this.written = performance.now();
    window.history.replaceState(null, "", write(this.place()));
  }

  // ---- time

  private tick(now: number): void {
    const seconds = Math.min(LONGEST, (now - this.drawn) / 1000);
    this.drawn = now;
    this.flush();
    this.advance(now);
    this.body.draw(seconds);
    this.map.draw();
    this.strips.draw(now, this.moving(), this.body);
    if (this.moving() && now - this.written > ADDRESS_WHILE_MOVING) this.writeAddress();
    requestAnimationFrame((next) => this.tick(next));
  }

  private moving(): boolean {
    return this.playing && !this.ended && !document.hidden && this.connection.open && this.session !== null && !this.beginning;
  }

  /** Asks for the next stretch of the motion; never while one is under way. */
  private advance(now: number): void {
    if (!this.moving() || this.waiting) return;
    const dt = this.need().speed * Math.min(LONGEST, (now - this.asked) / 1000);
    this.asked = now;
    this.waiting = true;
    this.send({ do: "advance", dt: Math.max(0, dt) });
  }
}

/** The beginning of a preset or model, everything else left to it. */
function fresh(model: string, preset: string | null, playing: boolean): Place {
  return { model, preset, parameters: {}, plane: null, speed: null, noise: 0, section: null, y: null, playing, t: 0, position: null, state: null };
}
