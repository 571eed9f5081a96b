// @ts-check
// The charts of one robot.
import { Chart } from "./chart.js";

const CHARTS = /** @type {[Chart, number[]][]} */ ([ // and their columns of the history
  [new Chart("Speed", "m/s", 2, 0.1), [0]],
  [new Chart("Wheels, left · right", "rad/s", 1, 2), [1, 2]],
  [new Chart("Gap to the nearest", "m", 3, 0.05), [3]],
  [new Chart("Wheels off the camera", "mm", 1, 5), [4]],
  [new Chart("Round trip", "ms", 1, 5), [5]],
  [new Chart("Battery", "V", 2, 0.1), [6]],
]);

export class RobotCharts {
  /** @param {HTMLElement} element */
  constructor(element) {
    this.element = element;
    element.replaceChildren(...CHARTS.map(([chart]) => chart.element));
  }

  /** @param {import("./history.js").History} history @param {number | null} id */
  draw(history, id) {
    this.element.hidden = id === null;
    if (id === null) return;
    for (const [chart, columns] of CHARTS) {
      const { times, lines } = history.lines(id, columns);
      chart.draw(times, lines);
    }
  }
}
