// What the camera to be calibrated sees: the corners found, and the outline to be matched.
export class CalibrationView {
  constructor(canvas) {
    this.canvas = canvas;
    this.newest = 0;
  }

  clear() {
    this.newest++;
    this.canvas.width = this.canvas.width; // empties it
  }

  // Shows a picture, unless a newer one came meanwhile.
  async take(picture) {
    const number = ++this.newest, image = await createImageBitmap(picture.jpeg);
    if (number === this.newest) this.draw(image, picture);
    image.close();
  }

  draw(image, picture) {
    this.canvas.width = picture.width_px;
    this.canvas.height = picture.height_px;
    const pen = this.canvas.getContext("2d");
    pen.drawImage(image, 0, 0);
    pen.translate(0.5, 0.5); // an integer pixel is a pixel's centre
    this.drawOutline(pen, picture.outline_px);
    pen.fillStyle = "#00c2ff";
    for (const [x, y] of picture.corners_px) pen.fillRect(x - 2, y - 2, 4, 4);
    this.canvas.dataset.corners = picture.corners_px.length;
  }

  drawOutline(pen, outline) {
    pen.beginPath();
    for (const [x, y] of outline) if (x !== null && y !== null) pen.lineTo(x, y);
    pen.closePath();
    for (const [color, width] of [["#000", 6], ["#ffd60a", 3]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.stroke();
    }
    const [x, y] = outline[0] ?? [null, null];
    if (x === null || y === null) return;
    pen.fillStyle = "#ffd60a";
    pen.beginPath();
    pen.arc(x, y, 7, 0, 2 * Math.PI); // the board's top left corner
    pen.fill();
  }
}
