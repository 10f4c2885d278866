/** Who hears which answer. What belongs to an earlier motion is left aside here, once for all. */

import type { Answer, Begun, Changed, Defined, Exponents, Hello, Member, Mistake, Named, Orbit, Refused, ReturnsAhead, Share, Source, Strips } from "./protocol";
import type { BranchPanel } from "./branches/panel";
import type { MapPanel } from "./map/panel";

/** The page, as the server speaks to it. */
export interface Hearer {
  readonly map: MapPanel;
  readonly branches: BranchPanel;
  /** Revision of the motion that the page shows. */
  revision(): number;
  hello(answer: Hello): void;
  begun(answer: Begun): void;
  changed(answer: Changed): void;
  naming(): void;
  named(answer: Named): void;
  exponents(answer: Exponents): void;
  /** Also of an earlier motion: another question may then follow. */
  analysed(answer: Strips, current: boolean): void;
  returned(answer: ReturnsAhead): void;
  member(answer: Member): void;
  ended(text: string): void;
  shared(answer: Share): void;
  source(answer: Source): void;
  defined(answer: Defined): void;
  mistaken(answer: Mistake): void;
  refused(answer: Refused): void;
  /** The orbit that the body is placed on; it may come before the change. */
  orbit(answer: Orbit): void;
}

export function dispatch(answer: Answer, to: Hearer): void {
  switch (answer.is) {
    case "hello":
      return to.hello(answer);
    case "begun":
      return to.begun(answer);
    case "changed":
      return to.changed(answer);
    case "map":
      return to.map.started(answer);
    case "progress":
      return to.map.progress(answer);
    case "mapped":
      return to.map.mapped(answer);
    case "evidence":
      return to.map.evidence(answer);
    case "branches":
      return to.branches.begun(answer);
    case "branch":
      return to.branches.branch(answer);
    case "specials":
      return to.branches.specials(answer);
    case "following":
      return to.branches.following(answer);
    case "followed":
      return to.branches.followed(answer);
    case "orbit":
      return to.orbit(answer);
    case "share":
      return to.shared(answer);
    case "source":
      return to.source(answer);
    case "defined":
      return to.defined(answer);
    case "mistake":
      return to.mistaken(answer);
    case "refused":
      return to.refused(answer);
    case "strips":
      return to.analysed(answer, answer.revision === to.revision());
  }
  if (answer.revision !== to.revision()) return;
  switch (answer.is) {
    case "naming":
      return to.naming();
    case "named":
      return to.named(answer);
    case "exponents":
      return to.exponents(answer);
    case "member":
      return to.member(answer);
    case "returns":
      return to.returned(answer);
    case "ended":
      return to.ended(answer.text);
  }
}
