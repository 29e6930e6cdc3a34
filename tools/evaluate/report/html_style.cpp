#include "tools/evaluate/report/html_style.h"

namespace goalmouth {

const char* html_style() {
    return R"(
:root {
  color-scheme: light dark;
  --page: #ffffff; --raised: #f6f8fa; --ink: #1f2328; --quiet: #59636e; --rule: #d1d9e0; --link: #0a62b8;
  --good-ink: #116329; --good: #dafbe1; --bad-ink: #a40e26; --bad: #ffebe9; --note: #fff8c5; --note-rule: #d4a72c;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #14181d; --raised: #1c2229; --ink: #e2e6ea; --quiet: #9aa4af; --rule: #39424c; --link: #6cb6ff;
    --good-ink: #7ee2a0; --good: #12351f; --bad-ink: #ffaba3; --bad: #46191a; --note: #332b12; --note-rule: #9e7d1f;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; scroll-behavior: smooth; }
body {
  margin: 0 auto; padding: 1.5rem 1.1rem 4rem; max-width: 76rem;
  background: var(--page); color: var(--ink);
  font: 1rem/1.6 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
}
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0.6rem 0 0.8rem; text-wrap: balance; }
h2 { font-size: 1.35rem; line-height: 1.3; margin: 3rem 0 0.8rem; padding-bottom: 0.3rem; border-bottom: 1px solid var(--rule); }
h3 { font-size: 1.08rem; margin: 2rem 0 0.5rem; }
p, ul, dl { max-width: 46rem; margin: 0.7rem 0; }
a { color: var(--link); }
.lead { font-size: 1.12rem; color: var(--quiet); }
nav { margin: 1.6rem 0; padding: 0.7rem 1.1rem; background: var(--raised); border-radius: 8px; }
nav ol { margin: 0; padding: 0; list-style: none; display: flex; flex-wrap: wrap; gap: 0.15rem 1.5rem; }
nav a { text-decoration: none; }
nav a:hover { text-decoration: underline; }
.note { padding: 0.6rem 1rem; background: var(--note); border-left: 4px solid var(--note-rule); border-radius: 0 6px 6px 0; }
pre { padding: 0.8rem 1rem; background: var(--raised); border-radius: 8px; white-space: pre-wrap; overflow-wrap: anywhere;
  font: 0.87rem/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
dl { display: grid; grid-template-columns: minmax(6rem, max-content) 1fr; gap: 0.25rem 1.4rem; }
dt { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; }
.wide { overflow-x: auto; margin: 1.2rem 0 0.4rem; }
table { border-collapse: collapse; font-size: 0.93rem; line-height: 1.4; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding: 0 0 0.5rem; color: var(--quiet); }
th, td { padding: 0.32rem 0.6rem; text-align: left; vertical-align: baseline; white-space: nowrap; }
thead th { font-weight: 600; white-space: normal; border-bottom: 2px solid var(--rule); vertical-align: bottom; }
.groups th { text-align: center; border-bottom: 1px solid var(--rule); }
tbody th { font-weight: 400; }
tbody tr { border-bottom: 1px solid var(--rule); }
tbody tr:hover { background: var(--raised); }
.n { text-align: right; }
.strong { font-weight: 700; }
.good { background: var(--good); color: var(--good-ink); }
.bad { background: var(--bad); color: var(--bad-ink); }
td.bad { font-weight: 600; }
.legend { margin-top: 0; font-size: 0.87rem; }
.legend span { padding: 0.1rem 0.5rem; border-radius: 4px; margin-right: 0.5rem; }
figure { margin: 1.2rem 0; }
figcaption { margin-top: 0.35rem; font-size: 0.9rem; line-height: 1.45; color: var(--quiet); max-width: 46rem; overflow-wrap: anywhere; }
figure svg { display: block; width: 100%; height: auto; color: var(--ink); }
figure img { display: block; max-width: 100%; height: auto; border-radius: 6px; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 0.6rem 1.4rem; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 19rem), 1fr)); gap: 1.2rem; margin: 1.2rem 0; }
.grid figure { margin: 0; }
.grid img { width: 100%; }
.zoom { display: block; cursor: zoom-in; }
.zoom input { position: absolute; opacity: 0; }
.zoom input:focus-visible + img { outline: 3px solid var(--link); outline-offset: 2px; }
.zoom input:checked + img { position: fixed; z-index: 1; inset: 0; width: 100vw; height: 100vh; max-width: none;
  object-fit: contain; background: #000000e6; border-radius: 0; cursor: zoom-out; }
details { margin: 1.2rem 0; border: 1px solid var(--rule); border-radius: 8px; padding: 0 1rem; }
summary { padding: 0.6rem 0; cursor: pointer; font-weight: 600; }
details[open] { padding-bottom: 0.6rem; }
@media print {
  :root { --page: #ffffff; --raised: #f6f8fa; --ink: #000000; --quiet: #444444; --rule: #bbbbbb; --link: #000000;
    --good-ink: #116329; --good: #dafbe1; --bad-ink: #a40e26; --bad: #ffebe9; --note: #fff8c5; --note-rule: #d4a72c; }
  body { max-width: none; padding: 0; font-size: 10.5pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  nav { display: none; }
  h2, h3 { break-after: avoid; }
  figure, tr, .note { break-inside: avoid; }
  .wide { overflow: visible; }
}
)";
}

}  // namespace goalmouth
