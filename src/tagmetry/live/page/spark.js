// A small line of the newest numbers, in the colour of its text.
const KEPT = 120;

export class Spark {
  constructor(canvas) {
    this.canvas = canvas;
    this.values = [];
  }

  take(value) {
    this.values.push(value);
    if (this.values.length > KEPT) this.values.shift();
  }

  draw() {
    const { canvas, values } = this, ratio = devicePixelRatio || 1;
    const w = canvas.clientWidth, h = canvas.clientHeight;
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
    const known = values.filter((one) => one !== null);
    if (!known.length) return;
    const top = Math.max(...known, 1e-9), low = Math.min(...known, 0);
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    pen.strokeStyle = getComputedStyle(canvas).color;
    pen.lineWidth = 1.5;
    pen.beginPath();
    values.forEach((one, n) => {
      if (one !== null) pen.lineTo((w * n) / (KEPT - 1), h - 1.5 - ((h - 3) * (one - low)) / (top - low));
    });
    pen.stroke();
  }
}
