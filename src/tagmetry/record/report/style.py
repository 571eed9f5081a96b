"""How the page looks. Figures keep a white ground, so that they read the same in the dark."""

STYLE = """
:root { color-scheme: light dark; --ground: #f6f7f9; --card: #fff; --ink: #1b1f24;
  --soft: #57606a; --line: #d8dee4; }
@media (prefers-color-scheme: dark) { :root { --ground: #14171b; --card: #1d2127; --ink: #e6e9ed;
  --soft: #9aa4af; --line: #363c44; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
main { max-width: 60rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
header { position: relative; padding: .5rem 0 1rem; }
h1 { margin: 0; font-size: 1.9rem; } h2 { margin: 0 0 .6rem; font-size: 1.25rem; }
h3 { margin: 1.2rem 0 .4rem; font-size: 1rem; }
header p { margin: .3rem 0; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 10px;
  padding: 1.1rem 1.3rem; margin: 1rem 0; }
.badge { position: absolute; top: .7rem; right: 0; padding: .2rem .9rem; border-radius: 99px;
  font-weight: 600; color: #fff; }
.good { background: #00724f; } .usable { background: #8a5a00; } .poor { background: #a63a00; }
.note, figcaption { color: var(--soft); font-size: .9rem; }
ul { margin: .2rem 0; padding-left: 1.2rem; } li { margin: .25rem 0; }
figure { margin: .6rem 0 1rem; }
figure > img { display: block; width: 100%; max-width: 44rem; margin: 0 auto; background: #fff;
  border-radius: 6px; }
figcaption { margin: .4rem auto 0; max-width: 44rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .86rem;
  font-variant-numeric: tabular-nums; }
th, td { padding: .28rem .6rem; text-align: right; border-bottom: 1px solid var(--line); }
th { color: var(--soft); font-weight: 600; vertical-align: bottom; }
th:first-child, td.text { text-align: left; }
.thumbs { display: grid; grid-template-columns: repeat(auto-fill, minmax(9rem, 1fr)); gap: .6rem; }
.thumbs figure { margin: 0; } .thumbs figcaption { text-align: center; font-size: .8rem; }
summary { cursor: pointer; margin: .8rem 0 .4rem; }
code { font-size: .95em; overflow-wrap: anywhere; }
"""
