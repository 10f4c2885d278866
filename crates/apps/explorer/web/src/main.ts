/** The page of a server. */

import { Connection } from "./connection";
import { start } from "./start";

start((listener) => new Connection(listener));
