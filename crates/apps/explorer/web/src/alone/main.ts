/** The page without a server. */

import { start } from "../start";
import { Alone } from "./alone";

start((listener) => new Alone(listener));
