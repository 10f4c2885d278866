/** The beat of the page: asks for the motion, one stretch at a time, and draws. */

/** Longest stretch, in seconds of the wall: after a pause the body goes on from where it was. */
const LONGEST = 0.1;

/** What happens in a beat. */
export interface Beat {
  /** Whether the motion may be asked for now. */
  ready(): boolean;
  /** Model time per second. */
  speed(): number;
  advance(dt: number): void;
  /** Before anything else. */
  before(now: number): void;
  /** Everything that is drawn; `now` in milliseconds, `seconds` since the last picture. */
  draw(now: number, seconds: number): void;
}

export class Loop {
  playing = true;
  /** The body is in the hand: it rests. */
  held = false;
  /** The motion is over: nothing is asked for until it changes. */
  ended = false;
  /** Whether a stretch is under way. */
  private waiting = false;
  private asked = 0;
  private drawn = 0;

  constructor(private readonly beat: Beat) {
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Whether the body moves. */
  moving(): boolean {
    return this.playing && !this.held && !this.ended && !document.hidden && this.beat.ready();
  }

  /** The stretch that was asked for came, or never will. */
  received(): void {
    this.waiting = false;
  }

  /** Asks for a picture of now. */
  look(): void {
    this.waiting = true;
    this.asked = performance.now();
    this.beat.advance(0);
  }

  private tick(now: number): void {
    const seconds = Math.min(LONGEST, (now - this.drawn) / 1000);
    this.drawn = now;
    this.beat.before(now);
    this.advance(now);
    this.beat.draw(now, seconds);
    requestAnimationFrame((next) => this.tick(next));
  }

  private advance(now: number): void {
    if (!this.moving()) {
      this.asked = now;
      return;
    }
    if (this.waiting) return;
    const dt = this.beat.speed() * Math.max(0, Math.min(LONGEST, (now - this.asked) / 1000));
    this.asked = now;
    this.waiting = true;
    this.beat.advance(dt);
  }
}
