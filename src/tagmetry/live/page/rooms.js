// The rooms: one is shown, the one that the address names (#arena); the first where it names none.
//
// A room is an object with `id`, and its part of the page is <section class="room" id="room-ID">:
//   welcome(message)  a connection was made: who this page is, and what there is
//   lost()            the connection is gone
//   take(message)     anything that the server tells, also while another room is shown; may return
//                     a promise that it is shown
//   open(), close()   this room is shown, or another one
export class Rooms {
  constructor(rooms) {
    this.rooms = rooms;
    this.links = new Map(rooms.map((one) => [one, link(one)]));
    document.getElementById("rooms").replaceChildren(...this.links.values());
    this.shown = null;
    addEventListener("hashchange", () => this.follow(true));
    new ResizeObserver(() => this.reveal()).observe(document.getElementById("rooms"));
    this.follow(false);
  }

  welcome(message) { for (const one of this.rooms) one.welcome(message); }
  lost() { for (const one of this.rooms) one.lost(); }
  take(message) { return Promise.allSettled(this.rooms.map((one) => one.take(message))); }

  follow(isMove) {
    const named = this.rooms.find((one) => `#${one.id}` === location.hash) ?? this.rooms[0];
    if (named === this.shown) return;
    this.shown?.close();
    this.shown = named;
    for (const [room, link] of this.links) this.mark(room, link);
    this.reveal();
    named.open();
    if (isMove) section(named).focus({ preventScroll: true });
    scrollTo(0, 0);
  }

  mark(room, link) {
    section(room).hidden = room !== this.shown;
    if (room !== this.shown) return link.removeAttribute("aria-current");
    link.setAttribute("aria-current", "page");
  }

  // On a phone some links are out of sight: the shown room's comes into the middle.
  reveal() { this.links.get(this.shown).scrollIntoView({ block: "nearest", inline: "center" }); }
}

function section(room) { return document.getElementById(`room-${room.id}`); }

function link(room) {
  const made = document.createElement("a");
  made.href = `#${room.id}`;
  made.textContent = section(room).getAttribute("aria-label");
  return made;
}
