// What the camera sees, with the outline, id and heading of every marker that was found in it.
import { hue } from "./map.js";

export class CameraView {
  constructor(canvas) {
    this.canvas = canvas;
    this.shown = -Infinity;
  }

  // Shows a picture, unless a newer one was shown meanwhile.
  async take(picture) {
    const image = await createImageBitmap(picture.jpeg);
    if (picture.time_s >= this.shown) this.draw(image, picture);
    image.close();
  }

  clear() { this.shown = -Infinity; }

  draw(image, picture) {
    this.shown = picture.time_s;
    this.canvas.width = picture.width_px;
    this.canvas.height = picture.height_px;
    const pen = this.canvas.getContext("2d");
    pen.drawImage(image, 0, 0, picture.width_px, picture.height_px);
    pen.translate(0.5, 0.5); // an integer pixel is a pixel's centre
    for (const one of picture.markers) this.drawMarker(pen, one);
  }

  drawMarker(pen, one) {
    const [cx, cy] = [0, 1].map((n) => one.corners_px.reduce((sum, c) => sum + c[n], 0) / 4);
    pen.strokeStyle = hue(one.robot_id, 1);
    pen.lineWidth = 2.5;
    pen.beginPath();
    for (const [x, y] of one.corners_px) pen.lineTo(x, y);
    pen.closePath();
    pen.moveTo(cx, cy);
    pen.lineTo(...one.front_px);
    pen.stroke();
    pen.font = "bold 18px system-ui, sans-serif";
    pen.lineWidth = 4;
    pen.strokeStyle = "#000";
    pen.fillStyle = "#fff";
    const [x, y] = [cx + 22, cy - 18];
    pen.strokeText(String(one.robot_id), x, y);
    pen.fillText(String(one.robot_id), x, y);
  }
}
