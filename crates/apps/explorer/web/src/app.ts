/** Brings the parts together: what the server says goes to the panels, what the reader does goes to the server. */

import { fresh, read, type Place } from "./address";
import type { Frame } from "./binary";
import { BodyPanel } from "./body/panel";
import { showName } from "./body/naming";
import { BranchPanel } from "./branches/panel";
import { Compare } from "./compare";
import { Controls } from "./controls";
import { dispatch, type Hearer } from "./dispatch";
import { byId, setText } from "./dom";
import { Editor } from "./editor";
import { Hand } from "./hand";
import { expose } from "./handle";
import { History } from "./history";
import { Keeper } from "./keeper";
import { Later } from "./later";
import type { Connect, Transport } from "./listener";
import { Loop } from "./loop";
import { MapPanel } from "./map/panel";
import { apart } from "./map/sides";
import { pretty, typeset } from "./numbers";
import { Opening } from "./opening";
import { ParameterPanel } from "./parameters";
import { PresetBar } from "./presets";
import type { Begun, Changed, Defined, Exponents, Hello, Member, Mistake, Model, Named, Orbit, Refused, Regime, ReturnsAhead, Share, Source, Strips, Values, Wish } from "./protocol";
import { Session } from "./session";
import { ShareMenu } from "./share";
import { showConnected, showConnection, showSilence } from "./status";
import { StripPanels } from "./strips/panels";
import { onTheme, visible } from "./theme";
import { SwarmPanel } from "./swarm";
import { toast } from "./toasts";
import { Tour } from "./tour/tour";
import { Undo } from "./undo";
import { units, unitsOf, useUnits } from "./units";

/** The body's colour while its motion has no name. */
const NAMELESS = "#888888";

export class App implements Hearer {
  /** Opened before the panels are built, and heard once they stand. */
  private readonly connection: Transport;
  readonly map: MapPanel;
  readonly branches: BranchPanel;
  private session: Session | null = null;
  private regime: Regime | null = null;
  private readonly opening = new Opening((begin) => this.send(begin));
  /** Whether parameters off the axes of the map changed. */
  private mapStale = false;
  private frames = 0;
  /** Whether the server has said hello on this connection. */
  private greeted = false;
  private readonly later = new Later();

  private readonly history = new History();
  private readonly keeper = new Keeper(() => this.place());
  private readonly undo = new Undo(() => this.place(), (place) => this.restore(place));
  private readonly hand = new Hand({
    send: (wish) => this.send(wish),
    speed: () => this.known().speed,
    rest: (held) => (this.loop.held = held),
    begins: () => this.undo.note(""),
  });
  private readonly swarm = new SwarmPanel({
    send: (wish) => this.send(wish),
    regimes: () => this.regimes(),
    noise: () => this.session?.noise ?? 0,
    changed: () => this.body?.touch(),
  });
  private readonly body: BodyPanel = new BodyPanel(this.history, (follow) => this.controls.setFollow(follow), this.hand, this.swarm.view);
  private readonly tour = new Tour((hash) => this.visit(read(hash, this.known().registry).place), () => this.keeper.changed());
  private readonly compare = new Compare((listener) => this.connect(listener), {
    now: () => ({ place: this.place(), session: this.session, plane: this.map.current() }),
    sight: () => this.body.sight(),
  });
  private readonly parameters = new ParameterPanel((name, value) => this.choose({ [name]: value }), () => this.send({ do: "source" }));
  private readonly editor = new Editor({ send: (wish) => this.send(wish), longest: () => this.connection.longest, run: (model) => this.run(model) });
  private readonly presets = new PresetBar((name) => this.openPreset(name), (name) => this.visit(fresh(name, null, this.loop.playing)));
  private readonly strips: StripPanels;
  private readonly controls: Controls;
  private readonly share: ShareMenu;
  private readonly loop: Loop;

  constructor(private readonly connect: Connect) {
    this.connection = connect({
      answer: (answer) => dispatch(answer, this),
      frame: (frame) => this.take(frame),
      cells: (cells) => this.map.cells(cells),
      file: (file) => void this.share.take(file),
      swarm: (frame) => this.swarm.take(frame),
      open: (open, code, reason) => this.opened(open, code, reason),
      silent: (silent) => showSilence(silent),
    });
    const send = (wish: Wish): void => this.send(wish);
    this.strips = new StripPanels(this.history, send, (time) => this.body.point(time), (before) => {
      const place = this.place();
      this.undo.note("", place && { ...place, ...before });
      this.keeper.changed();
    });
    const known = { regimes: () => this.regimes(), model: () => this.known().model, parameters: () => this.session?.parameters ?? {} };
    this.branches = new BranchPanel({
      send,
      ...known,
      plane: () => this.map.current(),
      touchMap: () => this.map.touch(),
    });
    this.map = new MapPanel({
      upon: this.branches,
      send,
      ...known,
      parameters: () => ({ ...this.session?.parameters, ...this.session?.start }),
      choose: (values) => this.chooseOnMap(values),
      moves: () => this.undo.note("window"),
      moved: () => this.windowMoved(),
    });
    this.controls = new Controls({
      play: (playing) => this.play(playing),
      restart: () => this.send({ do: "restart" }),
      kick: (strength) => this.send({ do: "kick", strength }),
      noise: (amplitude) => this.send({ do: "noise", amplitude }),
      speed: (speed) => this.setSpeed(speed),
      trail: (time) => this.body.setTrail(time),
      follow: (follow) => this.body.setFollow(follow),
    });
    this.share = new ShareMenu({ send, connected: () => this.greeted, section: () => this.strips.section(), link: () => this.keeper.link() });
    this.loop = new Loop({
      ready: () => this.greeted && this.session !== null && !this.opening.under,
      speed: () => this.known().speed,
      advance: (dt) => this.send({ do: "advance", dt }),
      before: (now) => this.flush(now),
      draw: (now, seconds) => this.draw(now, seconds),
    });
    onTheme(() => this.recolour());
    // The event knows the address that was asked for; the bar may have been written to since.
    window.addEventListener("hashchange", (event) => {
      this.undo.note("");
      this.openAddress(new URL(event.newURL).hash);
    });
    expose({ frames: () => this.frames, revision: () => this.revision(), frame: () => (this.later.due ? null : this.body.last()), beside: () => this.compare.shown(), map: this.map, branches: this.branches, body: this.body });
  }

  /** All regimes, those by sense last, as the bytes of cells count them. */
  private regimes(): Regime[] {
    const { regimes = [], turning = [] } = this.session?.registry ?? {};
    return [...regimes, ...turning];
  }

  private known(): Session {
    if (!this.session) throw new Error("the server has not sent its first message yet");
    return this.session;
  }

  /** Before the greeting there is nobody to hear: what is refused then would be taken for a refusal of the beginning. */
  private send(wish: Wish): void {
    if (!this.greeted) return;
    if (wish.do === "noise") this.undo.note("noise");
    else if (wish.do === "kick" || wish.do === "restart" || wish.do === "start" || wish.do === "place") this.undo.note("");
    this.connection.send(wish);
  }

  private draw(now: number, seconds: number): void {
    const moving = this.loop.moving();
    if (this.body.draw(seconds)) this.later.go();
    this.map.draw();
    this.branches.draw();
    this.compare.draw(seconds, moving);
    this.strips.draw(now, moving, this.body);
    if (moving) this.keeper.moving(now);
  }

  private recolour(): void {
    this.map.touch();
    this.branches.touch();
    this.strips.touch();
    this.compare.touch();
    this.paintBody();
  }

  // ---- what the server says

  revision(): number {
    return this.session?.revision ?? -1;
  }

  private opened(open: boolean, code: number, reason = ""): void {
    showConnection(open, code);
    if (reason) toast(reason);
    this.greeted = false;
    this.loop.received();
    if (!open) this.share.drop();
  }

  /** The first greeting opens the address; after a loss of the connection the body goes on where it was. */
  hello({ registry, restart, version, tracked }: Hello): void {
    this.greeted = true;
    showConnected(restart !== "");
    setText(byId("banner-command"), restart);
    byId("connection").title = `motiform ${version}`;
    const place = this.place();
    this.session = new Session(registry, tracked);
    this.presets.fill(registry);
    this.editor.restore((model) => {
      if (model) this.define(model);
      if (place) this.open(place);
      else this.openAddress();
    });
  }

  source({ text }: Source): void {
    this.editor.open(text);
  }

  defined({ model }: Defined): void {
    this.editor.defined(model);
  }

  mistaken(mistake: Mistake): void {
    this.editor.mistaken(mistake);
  }

  private define(model: Model): void {
    this.known().define(model);
    this.presets.add(model);
  }

  /** A model that the reader wrote. */
  private run(model: Model): void {
    this.define(model);
    this.visit(fresh(model.name, null, this.loop.playing));
  }

  begun(begun: Begun): void {
    const session = this.known();
    const place = this.opening.agreed();
    session.begun(begun, this.speedOf(place, begun));
    this.history.clear();
    this.swarm.clear();
    useUnits(unitsOf(session));
    this.body.begin();
    this.compare.begin(session);
    if (this.map.current()) this.branches.forget();
    this.loop.look();
    document.title = `${begun.title} \u2013 motiform`;
    this.presets.show(session.model, begun.preset, begun.about || session.model.title);
    this.controls.setSpeed(session.speed, begun.speeds);
    this.controls.setTrail(begun.speed);
    this.renew(session);
    this.later.put(() => this.furnish(session, place));
  }

  /** What surrounds the body; its first picture does not wait for it. */
  private furnish({ model, preset, base, parameters }: Session, place: Place | null): void {
    this.parameters.begin(model, preset, base);
    this.parameters.show(parameters);
    if (place?.section) this.strips.begin(model.observables, place.section, place.y);
    else this.strips.begin(model.observables, preset?.section ?? "speed", null);
    const home = preset?.plane ?? model.plane;
    this.map.begin(place?.plane ?? home, home);
    this.tour.mark();
    this.windowMoved();
  }

  /** The speed of a place, where it is one that the slider has. */
  private speedOf(place: Place | null, { speed, speeds }: Begun): number {
    const wanted = place?.speed ?? speed;
    const [least, most] = [0.999 * speeds[0], 1.001 * speeds[1]];
    if (wanted >= least && wanted <= most) return wanted;
    toast(`Ignored in the address: speed=${pretty(wanted, 3)}`);
    return speed;
  }

  changed(changed: Changed): void {
    const session = this.known();
    const moved = session.agreed(changed);
    this.hand.answered();
    // A point of a branch may lie off the map, whose axes were changed since.
    if (moved.some((name) => !this.map.isAxis(name))) this.map.renew();
    if (!this.loop.playing || this.loop.held) this.loop.look();
    this.renew(session);
  }

  /** The motion is another one: no name, no exponents, and the body may move again. */
  private renew(session: Session): void {
    this.parameters.show(session.parameters);
    this.body.renew(session.revision, session.parameters);
    this.presets.depart(session.departed());
    this.controls.setNoise(session.noise);
    this.map.touch();
    this.loop.ended = false;
    byId("ended").hidden = true;
    this.naming();
    this.swarm.renew();
    this.strips.renew();
    this.keeper.changed();
  }

  naming(): void {
    this.name(null, "");
  }

  named({ regime, why }: Named): void {
    this.name(this.regimes().find((one) => one.name === regime) ?? null, typeset(why, units().time));
  }

  private name(regime: Regime | null, why: string): void {
    this.regime = regime;
    showName(regime, why, regime ? null : this.map.nameHere());
    this.paintBody();
  }

  /** The body takes the colour of its regime. */
  private paintBody(): void {
    this.body.setColour(visible(this.regime?.colour ?? NAMELESS));
  }

  exponents(exponents: Exponents): void {
    this.strips.exponents(exponents);
  }

  analysed(strips: Strips, current: boolean): void {
    this.strips.take(strips, current);
  }

  member(member: Member): void {
    this.swarm.member(member);
  }

  returned(ahead: ReturnsAhead): void {
    this.strips.returned(ahead);
  }

  ended(text: string): void {
    this.loop.ended = true;
    setText(byId("ended-text"), typeset(text));
    byId("ended").hidden = false;
  }

  shared(share: Share): void {
    this.share.show(share);
  }

  refused({ id, why }: Refused): void {
    if (id !== null && this.share.refuse(id, why)) return;
    if (this.opening.under) return this.opening.refused(why, this.known());
    const names = this.session?.refused(why) ?? [];
    if (!this.parameters.refuse(names, why)) toast(why);
    if (this.session) this.parameters.show(this.session.parameters);
    this.map.touch();
  }

  orbit(orbit: Orbit): void {
    this.body.place(orbit);
  }

  private take(frame: Frame): void {
    this.loop.received();
    this.frames++;
    if (frame.revision < this.revision()) return;
    const first = this.body.last() === null;
    this.history.take(frame);
    this.body.take(frame);
    if (first || !this.loop.playing) this.keeper.changed();
  }

  // ---- what the reader does

  private openPreset(name: string): void {
    const preset = this.known().registry.presets.find((one) => one.name === name);
    if (!preset) return;
    this.tour.show(null);
    this.visit(fresh(preset.model, name, this.loop.playing));
  }

  /** Another place: Back comes back to this one as it is now. */
  private visit(place: Place): void {
    this.undo.note("");
    this.keeper.leave(place);
    this.open(place);
  }

  private openAddress(hash = location.hash): void {
    const { place, notes } = read(hash, this.known().registry);
    if (notes.length) toast(`Ignored in the address: ${notes.join(", ")}`);
    this.tour.show(place.tour);
    this.loop.playing = place.playing;
    this.controls.setPlaying(place.playing);
    this.open(place);
  }

  /** A place of before: the same body is changed, another one begins. */
  private restore(place: Place): void {
    const session = this.known();
    if (place.model !== session.model.name || place.preset !== (session.preset?.name ?? null)) return this.open(place);
    const { state, position, t } = place;
    session.start = {}; // the body of before began elsewhere
    const noise = place.noise ?? session.model.noise;
    this.send({ do: "put", parameters: { ...session.base, ...place.parameters }, state, position, velocity: null, t, noise: noise === session.noise ? null : noise });
    if (place.plane) this.map.return(place.plane);
    if (place.speed !== null) session.speed = place.speed;
    this.controls.turnSpeed(session.speed);
    if (place.section) this.strips.choose(place.section, place.y);
    this.keeper.changed();
  }

  private open(place: Place): void {
    this.opening.open(place, this.known());
  }

  /** New values: sent with the next frame, in one message however many there are. */
  private choose(values: Values): void {
    if (!this.session) return;
    this.undo.note(`set ${Object.keys(values).join()}`);
    this.session.want(values);
    this.parameters.show(this.session.parameters);
    this.map.touch();
    const off = Object.keys(values).filter((name) => !this.map.isAxis(name));
    this.mapStale ||= off.length > 0;
    if (off.some((name) => name !== this.branches.along)) this.branches.forget();
    this.keeper.changed();
  }

  /** Parameters, and coordinates at which the body begins again. */
  private chooseOnMap(values: Values): void {
    if (!this.session) return;
    const { parameters, start } = apart(this.session.model, values);
    if (Object.keys(parameters).length) this.choose(parameters);
    if (Object.keys(start).length === 0) return;
    Object.assign(this.session.start, start);
    this.send({ do: "start", coordinates: this.session.start });
    this.map.touch();
  }

  private flush(now: number): void {
    this.hand.flush(now);
    const values = this.opening.under ? null : this.session?.take(now);
    if (!values) return;
    this.send({ do: "set", parameters: values });
    if (this.mapStale) this.map.renew();
    this.mapStale = false;
  }

  private play(playing: boolean): void {
    this.loop.playing = playing;
    this.controls.setPlaying(playing);
    this.keeper.write();
  }

  private setSpeed(speed: number): void {
    this.undo.note("speed");
    this.known().speed = speed;
    this.keeper.changed();
  }

  private windowMoved(): void {
    const plane = this.map.current();
    this.share.showStrip(plane !== null && plane.y === null);
    this.parameters.markAxes(plane?.x.name ?? null, plane?.y?.name ?? null);
    this.branches.axes();
    this.keeper.changed();
  }

  /** Everything that the address holds; `null` before the body has been seen. */
  private place(): Place | null {
    const [session, frame] = [this.session, this.body.last()];
    if (!session || !frame || this.opening.under || this.later.due) return null;
    return {
      model: session.model.name,
      preset: session.preset?.name ?? null,
      parameters: session.changed(),
      plane: this.map.current(),
      speed: session.speed,
      noise: session.noised(),
      ...this.strips.section(),
      playing: this.loop.playing,
      tour: this.tour.step,
      t: frame.t,
      position: [frame.x, frame.y],
      state: [...frame.state],
    };
  }
}
