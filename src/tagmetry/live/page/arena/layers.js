// @ts-check
// What lies under and over the robots on the map: errors, obstacles, reach, ghosts, planned paths.
/**
 * @typedef {object} View
 * @property {CanvasRenderingContext2D} pen its origin in the middle
 * @property {(x: number, y: number) => [number, number]} at from metres to the canvas
 * @property {(name: string) => string} color of the page's style
 * @property {number} k pixels per metre
 */

/** @param {View} view @param {import("../messages").FloorErrors} floor */
export function drawErrors({ pen, at, k }, floor) {
  const radial = floor.errors.map(([, , ex, ey]) => Math.hypot(ex, ey));
  const worst = Math.max(...radial, 1e-9), side = floor.step_m * k + 1;
  const long = (0.8 * floor.step_m * k) / worst;
  floor.errors.forEach(([x, y], n) => {
    const [px, py] = at(x, y);
    pen.fillStyle = heat(radial[n] / worst);
    pen.fillRect(px - side / 2, py - side / 2, side, side);
  });
  pen.strokeStyle = "#fff";
  pen.lineWidth = 1;
  pen.beginPath();
  for (const [x, y, ex, ey] of floor.errors) {
    const [px, py] = at(x, y);
    pen.moveTo(px, py);
    pen.lineTo(px + ex * long, py - ey * long);
  }
  pen.stroke();
}

/** @param {number} share @returns {string} from dark blue to yellow, as the reports have it */
export function heat(share) {
  return `hsl(${270 - 215 * share} ${45 + 30 * share}% ${24 + 32 * share}% / 0.8)`;
}

/** @param {View} view @param {import("../messages").Stage} stage */
export function drawStage({ pen, at, color, k }, stage) {
  pen.fillStyle = pen.strokeStyle = color("--soft");
  pen.lineWidth = 3;
  for (const [x, y, radius] of stage.discs) {
    pen.globalAlpha = 0.35;
    pen.beginPath();
    pen.arc(...at(x, y), radius * k, 0, 2 * Math.PI);
    pen.fill();
    pen.globalAlpha = 1;
  }
  for (const [ax, ay, bx, by] of stage.walls) stroke(pen, [at(ax, ay), at(bx, by)]);
  pen.strokeStyle = color("--warn");
  pen.lineWidth = 1.5;
  pen.setLineDash([8, 4]);
  if (stage.fence_m.length) {
    stroke(pen, [...stage.fence_m, stage.fence_m[0]].map(([x, y]) => at(x, y)));
  }
  pen.setLineDash([]);
}

/** How far a robot senses others. @param {View} view */
export function drawReach({ pen, at, color, k }, one, reach_m) {
  pen.strokeStyle = color("--accent");
  pen.lineWidth = 1;
  pen.setLineDash([2, 5]);
  pen.beginPath();
  pen.arc(...at(one.x_m, one.y_m), reach_m * k, 0, 2 * Math.PI);
  pen.stroke();
  pen.setLineDash([]);
}

/** Where a robot's wheels say that it is. @param {View} view */
export function drawGhost({ pen, at, color, k }, ghost, radius_m) {
  pen.strokeStyle = color("--warn");
  pen.lineWidth = 1.5;
  pen.setLineDash([2, 3]);
  stroke(pen, ghost.trail.map(([x, y]) => at(x, y)));
  const [x, y, heading] = ghost.place, [px, py] = at(x, y), r = radius_m * k;
  pen.beginPath();
  pen.arc(px, py, r, 0, 2 * Math.PI);
  pen.moveTo(px, py);
  pen.lineTo(px + 1.3 * r * Math.cos(heading), py - 1.3 * r * Math.sin(heading));
  pen.stroke();
  pen.setLineDash([]);
}

/** Points of a path that is not sent yet. @param {View} view @param {[number, number][]} points */
export function drawPlan({ pen, at, color }, points) {
  pen.strokeStyle = pen.fillStyle = color("--accent");
  pen.lineWidth = 2;
  stroke(pen, points.map(([x, y]) => at(x, y)));
  for (const [x, y] of points) {
    const [px, py] = at(x, y);
    pen.fillRect(px - 3, py - 3, 6, 6);
  }
}

function stroke(pen, places) {
  pen.beginPath();
  for (const [x, y] of places) pen.lineTo(x, y);
  pen.stroke();
}
