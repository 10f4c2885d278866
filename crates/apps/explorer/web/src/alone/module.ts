/** The module: compressed beside the page, or within it. */

/** Where a page that is one file has it, in base64. */
const WITHIN = "module";
const BESIDE = "motiform.wasm.gz";

let compiled: Promise<WebAssembly.Module> | null = null;

/** The compiled module; every session and helper has the same. */
export function code(): Promise<WebAssembly.Module> {
  compiled ??= compile();
  compiled.catch(() => (compiled = null)); // the next one tries again
  return compiled;
}

async function compile(): Promise<WebAssembly.Module> {
  const stream = (await compressed()).pipeThrough(new DecompressionStream("gzip"));
  // It is compiled while it comes.
  return WebAssembly.compileStreaming(new Response(stream, { headers: { "Content-Type": "application/wasm" } }));
}

async function compressed(): Promise<ReadableStream<BufferSource>> {
  const within = document.getElementById(WITHIN)?.textContent;
  if (within) {
    const digits = atob(within);
    const bytes = new Uint8Array(digits.length);
    for (let k = 0; k < digits.length; k++) bytes[k] = digits.charCodeAt(k); // a function called for each takes ten times as long
    return new Blob([bytes]).stream() as ReadableStream<BufferSource>;
  }
  const answer = await fetch(new URL(BESIDE, document.baseURI)).catch((error: unknown) => {
    // To a page without an origin every host is another one.
    const sandboxed = "in a sandboxed frame its host must allow it (Access-Control-Allow-Origin: *), or the page must be the one file motiform.html";
    throw window.origin === "null" ? new Error(`${BESIDE} cannot be read: ${sandboxed}`) : error;
  });
  if (!answer.ok || !answer.body) throw new Error(`${BESIDE}: ${answer.status}; put the whole folder that "cargo xtask web" writes on the host`);
  return answer.body as ReadableStream<BufferSource>;
}
