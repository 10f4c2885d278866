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
    const bytes = Uint8Array.from(atob(within), (digit) => digit.charCodeAt(0));
    return new Blob([bytes]).stream() as ReadableStream<BufferSource>;
  }
  const answer = await fetch(new URL(BESIDE, document.baseURI));
  if (!answer.ok || !answer.body) throw new Error(`${BESIDE}: ${answer.status}`);
  return answer.body as ReadableStream<BufferSource>;
}
