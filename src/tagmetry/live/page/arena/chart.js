// @ts-check
// A small chart of the newest minute: lines over time, its range at the left, newest at the right.
import { prepared } from "../canvas.js";
import { make } from "../make.js";

export const SPAN_S = 60;
const INK = ["--accent", "--warn"];

export class Chart {
  /**
   * @param {string} title
   * @param {string} unit
   * @param {number} digits of the numbers that are shown
   * @param {number} least span of the range, so that noise does not fill the chart
   */
  constructor(title, unit, digits, least) {
    this.title = title;
    this.unit = unit;
    this.digits = digits;
    this.least = least;
    this.caption = make("figcaption");
    this.canvas = make("canvas", { role: "img", "aria-label": `${title}, the newest minute` });
    this.element = make("figure", { className: "robot-chart" }, this.caption, this.canvas);
  }

  /**
   * @param {number[]} times
   * @param {(number | null)[][]} lines each as long as the times
   */
  draw(times, lines) {
    const newest = lines.map((line) => told(line.at(-1), this.digits));
    this.caption.textContent = `${this.title} ${newest.join(" · ")} ${this.unit}`;
    const { pen, width: w, height: h, color } = prepared(this.canvas);
    const known = lines.flat().filter((value) => value !== null);
    if (!known.length) return;
    const [low, high] = range(known, this.least), end = times.at(-1) ?? 0;
    const x = (time) => w - (w * (end - time)) / SPAN_S;
    const y = (value) => h - 4 - ((h - 8) * (value - low)) / (high - low);
    lines.forEach((line, n) => drawLine(pen, times, line, x, y, color(INK[n])));
    pen.fillStyle = color("--soft");
    pen.font = "11px system-ui, sans-serif";
    pen.fillText(told(high, this.digits), 3, 11);
    pen.fillText(told(low, this.digits), 3, h - 3);
  }
}

function drawLine(pen, times, line, x, y, ink) {
  pen.strokeStyle = ink;
  pen.lineWidth = 1.5;
  pen.beginPath();
  line.forEach((value, n) => {
    if (value === null) return;
    if (n && line[n - 1] !== null) pen.lineTo(x(times[n]), y(value));
    else pen.moveTo(x(times[n]), y(value));
  });
  pen.stroke();
}

function range(values, least) {
  const low = Math.min(...values), high = Math.max(...values);
  const more = Math.max(least - (high - low), 0) / 2;
  return [low - more, high + more];
}

function told(value, digits) {
  return value === null || value === undefined ? "–" : value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");
}
