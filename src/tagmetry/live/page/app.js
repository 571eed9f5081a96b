// Joins the page: one link to the server, the door, the stop button, and the rooms.
import { Door } from "./door.js";
import { Link } from "./link.js";
import { News } from "./news.js";
import { Notice } from "./notice.js";
import { Rooms } from "./rooms.js";
import { ArenaRoom } from "./rooms/arena.js";
import { CalibrateRoom } from "./rooms/calibrate.js";
import { HealthRoom } from "./rooms/health.js";
import { LensRoom } from "./rooms/lens.js";
import { LocateRoom } from "./rooms/locate.js";
import { PrintRoom } from "./rooms/print.js";
import { RecordingsRoom } from "./rooms/recordings.js";
import { watchStop } from "./stop.js";

const notice = new Notice(), news = new News();
const link = new Link(take, (state) => {
  door.show(state);
  if (state !== "live") rooms.lost();
});
const door = new Door(() => link.reopen());
const page = {
  send: (type, fields) => link.send(type, fields),
  notice: (text) => notice.show(text),
  get commands() { return door.commands; },
};
const rooms = new Rooms([
  new ArenaRoom(page),
  new RecordingsRoom(page),
  new CalibrateRoom(page),
  new LensRoom(page),
  new LocateRoom(page),
  new PrintRoom(),
  new HealthRoom(),
]);
let beating = null;

async function take(message) {
  const own = { Welcome: welcome, World: (one) => notice.stopped(one), Health: showHealth,
    Refused: (one) => notice.show(one.why) };
  own[message.type]?.(message);
  await rooms.take(message);
  if (message.type === "Picture") link.send("Seen", { taken_s: message.taken_s }); // the next one
}

function welcome(message) {
  door.welcome(message.role);
  clearInterval(beating);
  if (door.commands) beating = setInterval(beat, 1000 * message.beat_s);
  rooms.welcome(message);
}

// A page that nobody looks at says nothing: the server then stops what it drives.
function beat() {
  if (!document.hidden) link.send("Beat");
}

function showHealth(message) {
  news.take(message);
  if (message.notice) notice.show(message.notice);
}

watchStop(() => link.send("Stop"));
