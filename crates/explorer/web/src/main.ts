import "uplot/dist/uPlot.min.css";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/bar.css";
import "./styles/panels.css";
import "./styles/branches.css";
import "./styles/parameters.css";
import "./styles/overlays.css";
import "./styles/phone.css";
import { App } from "./app";
import { byId } from "./dom";
import { startTheme } from "./theme";

startTheme(byId<HTMLButtonElement>("theme"));
new App();
