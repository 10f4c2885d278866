/** Starts the page with a given transport: a server, or workers. */

import "uplot/dist/uPlot.min.css";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/bar.css";
import "./styles/panels.css";
import "./styles/branches.css";
import "./styles/parameters.css";
import "./styles/overlays.css";
import "./styles/words.css";
import "./styles/swarm.css";
import "./styles/tour.css";
import "./styles/phone.css";
import { App } from "./app";
import { startWhy } from "./body/naming";
import { byId } from "./dom";
import { startEmbed } from "./embed";
import { startKeys } from "./keys";
import { startDefinitions } from "./terms";
import type { Connect } from "./listener";
import { startTheme } from "./theme";

export function start(connect: Connect): void {
  startTheme(byId<HTMLButtonElement>("theme"));
  startEmbed();
  startDefinitions();
  startWhy();
  startKeys();
  new App(connect);
}
