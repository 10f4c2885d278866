/** How long a map takes, seen by a socket of its own. */

/** Seconds until each cell of the map of figure 1 has a first look, and until all are there. */
export function mapTimes(page, address, count) {
  return page.evaluate(([where, cells]) => new Promise((done, fail) => {
    const socket = new WebSocket(where);
    socket.binaryType = "arraybuffer";
    let [asked, coarse, seen, left, sides] = [0, null, null, 0, [0, 0]];
    const say = (wish) => socket.send(JSON.stringify(wish));
    const take = (data) => {
      const view = new DataView(data);
      if (view.getUint8(0) !== 2) return;
      for (let k = 0; k < view.getUint16(2, true); k++) {
        const at = 16 + 16 * k;
        const [i, j, size] = [view.getUint16(at, true), view.getUint16(at + 2, true), 2 ** view.getUint8(at + 4)];
        const first = (n) => Math.max(0, n - Math.floor(size / 2));
        for (let x = first(i); x < Math.min(sides[0], first(i) + size); x++) {
          for (let y = first(j); y < Math.min(sides[1], first(j) + size); y++) left -= seen[x + sides[0] * y] ? 0 : (seen[x + sides[0] * y] = 1);
        }
      }
      if (left <= 0) coarse ??= performance.now();
    };
    const hear = (answer) => {
      if (answer.is === "hello") say({ do: "begin", model: "tensor", preset: "fig1", parameters: {}, state: null, position: null, t: 0, noise: 0, seed: 1 });
      if (answer.is === "begun") {
        const plane = { x: { name: "kappa2", low: -0.22, high: 0.22 }, y: { name: "gamma", low: -0.16, high: 0.12 } };
        asked = performance.now();
        say({ do: "map", epoch: 1, ...plane, count: cells });
      }
      if (answer.is === "map") {
        sides = [answer.x.count, answer.y.count];
        left = sides[0] * sides[1];
        seen = new Uint8Array(left);
      }
      if (answer.is === "mapped") {
        done({ cells: answer.cells, coarse: (coarse - asked) / 1000, complete: (performance.now() - asked) / 1000 });
        socket.close();
      }
    };
    socket.onmessage = ({ data }) => (typeof data === "string" ? hear(JSON.parse(data)) : take(data));
    socket.onerror = () => fail(new Error(`no socket at ${where}`));
  }), [address, count]);
}
