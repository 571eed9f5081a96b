// The room from above: markers on the walls, the way of the camera, ellipses, where it truly was.
import { prepared } from "../canvas.js";

const TIMES = 10; // ellipses are too small to be seen
const APART = 5; // points from one ellipse to the next
const EDGE_M = 0.35;

export function drawRoom(canvas, trace) {
  const { pen, width, height, color } = prepared(canvas);
  const ends = (trace?.markers ?? []).flatMap((one) => [one.left_m, one.right_m]);
  if (!ends.length) return;
  const [x0, x1] = span(ends.map((end) => end[0])), [y0, y1] = span(ends.map((end) => end[1]));
  const k = Math.min(width / (x1 - x0), height / (y1 - y0));
  const at = ([x, y]) => [width / 2 + k * (x - (x0 + x1) / 2), height / 2 - k * (y - (y0 + y1) / 2)];
  const seen = new Set(trace.residuals.map((one) => one.id));
  const middle = [width / 2, height / 2];
  for (const one of trace.markers) drawMarker(pen, one, seen.has(one.id), at, color, middle);
  drawPath(pen, trace.path, at, color);
  trace.path.forEach((one, n) => { if (n % APART === 0) drawEllipse(pen, one, at, k, color); });
  const last = trace.path.at(-1);
  if (last) drawCamera(pen, last, at, color);
}

function span(values) { return [Math.min(...values) - EDGE_M, Math.max(...values) + EDGE_M]; }

function drawMarker(pen, one, isSeen, at, color, middle) {
  const [a, b] = [at(one.left_m), at(one.right_m)];
  pen.strokeStyle = pen.fillStyle = color(isSeen ? "--accent" : "--soft");
  pen.lineWidth = isSeen ? 6 : 3;
  line(pen, [a, b]);
  pen.textAlign = "center";
  pen.font = isSeen ? "bold 13px system-ui, sans-serif" : "12px system-ui, sans-serif";
  pen.textBaseline = "middle";
  const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], far = Math.hypot(x - middle[0], y - middle[1]);
  const inward = 18 / (far || 1); // beside the bar, whichever wall it is on
  pen.fillText(String(one.id), x + inward * (middle[0] - x), y + inward * (middle[1] - y));
}

function drawPath(pen, path, at, color) {
  pen.strokeStyle = color("--accent");
  pen.lineWidth = 1.5;
  line(pen, path.map((one) => at([one.x_m, one.y_m])));
  pen.fillStyle = color("--good");
  for (const one of path) {
    if (one.true_m === null) continue; // nobody knows
    const [x, y] = at(one.true_m);
    pen.fillRect(x - 1.5, y - 1.5, 3, 3);
  }
}

function drawEllipse(pen, one, at, k, color) {
  const [long, short, turn] = one.ellipse;
  if (long === null || short === null) return;
  pen.strokeStyle = color("--ink");
  pen.lineWidth = 1;
  pen.beginPath();
  pen.ellipse(...at([one.x_m, one.y_m]), TIMES * long * k, TIMES * short * k, -turn, 0, 2 * Math.PI);
  pen.stroke();
}

function drawCamera(pen, one, at, color) {
  const [x, y] = at([one.x_m, one.y_m]);
  pen.fillStyle = pen.strokeStyle = color("--accent");
  pen.lineWidth = 3;
  line(pen, [[x, y], [x + 26 * Math.cos(one.heading_rad), y - 26 * Math.sin(one.heading_rad)]]);
  pen.beginPath();
  pen.arc(x, y, 6, 0, 2 * Math.PI);
  pen.fill();
}

function line(pen, points) {
  pen.beginPath();
  for (const point of points) pen.lineTo(...point);
  pen.stroke();
}
