/** What is said between the page and its workers. */

/** To a worker: the module first, then what to do with it. Texts are those of the protocol, and errands between a session and its helpers. */
export type Order =
  | { do: "load"; module: WebAssembly.Module }
  | { do: "begin"; mappers: number }
  | { do: "hear" | "report" | "assist"; text: string };

/** From a worker. `done`: the job of the last `assist` is done. */
export type Note =
  | { is: "text" | "post" | "back" | "fault"; text: string }
  | { is: "binary"; bytes: ArrayBuffer }
  | { is: "done" };
