/** A drawing as pixels, for a session that sends drawings alone. */

/** Pixels for a unit of the drawing, as the program's own PNG files have. */
const SCALE = 2;

/** The PNG of an SVG document, which has its fonts within and a white sheet. */
export async function png(svg: Blob): Promise<Blob> {
  const image = new Image();
  image.src = URL.createObjectURL(svg);
  try {
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [Math.ceil(image.width * SCALE), Math.ceil(image.height * SCALE)];
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, fail) => canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("the picture is too large"))), "image/png"));
  } finally {
    URL.revokeObjectURL(image.src);
  }
}
