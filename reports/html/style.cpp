#include "reports/html/style.h"

namespace rung {

std::string_view html_style() {
  return R"(:root{color-scheme:light dark;--ink:#1b1f24;--soft:#57606a;--paper:#fff;--field:#f3f5f7;--line:#d0d7de;--bad:#b42318;--bad-field:#fdecea;--warn:#7a4d00;--good:#1d6133;--new:#0b57d0}
@media (prefers-color-scheme:dark){:root{--ink:#e6e9ed;--soft:#9aa4af;--paper:#15181c;--field:#1e2329;--line:#3b4148;--bad:#ff9a8f;--bad-field:#3a1512;--warn:#f0b454;--good:#7fd194;--new:#7cb2ff}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.5rem;max-width:80rem;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif;overflow-wrap:anywhere}
h1,h2,h3,h4{line-height:1.25;margin:1.5rem 0 .5rem}
h1{margin-top:0}
h4{margin:.25rem 0}
p{margin:.4rem 0}
a{color:var(--new)}
:focus-visible{outline:3px solid var(--new);outline-offset:2px}
code,pre,table.scans{font-family:ui-monospace,monospace;font-size:.875rem}
pre{margin:.5rem 0;padding:.75rem;background:var(--field);overflow-x:auto}
.soft{color:var(--soft)}
.counts{display:flex;flex-wrap:wrap;gap:.5rem;padding:0;margin:1rem 0;list-style:none}
.counts li{padding:.4rem .8rem;border:1px solid var(--line);border-radius:.4rem}
.counts b{font-size:1.25rem;margin-right:.3rem}
.bad,.verdict.violated,.error{color:var(--bad)}
.warn,.verdict.bounded,.verdict.vacuous,.verdict.unknown,.warning{color:var(--warn)}
.good,.verdict.proved{color:var(--good)}
.scroll{overflow-x:auto;max-width:100%}
table{border-collapse:collapse}
th,td{padding:.2rem .6rem;border-bottom:1px solid var(--line);text-align:right}
th:first-child{text-align:left}
thead th{vertical-align:bottom}
td.changed{color:var(--new);font-weight:bold}
td.remark{text-align:left;color:var(--soft)}
details,article{margin:.5rem 0;padding:.5rem .75rem;border:1px solid var(--line);border-radius:.4rem}
details.violated{border-color:var(--bad);border-left-width:.35rem}
details.violated summary{background:var(--bad-field)}
summary{cursor:pointer;margin:-.5rem -.75rem;padding:.5rem .75rem}
details[open] summary{margin-bottom:.5rem}
.verdict{display:inline-block;min-width:5.5rem;font-weight:bold}
.run{display:flex;flex-wrap:wrap;gap:1.5rem;align-items:flex-start}
.run .scroll{flex:0 1 auto}
figure{margin:0 0 1rem}
figcaption{margin-bottom:.25rem;color:var(--soft)}
@media print{body{max-width:none;padding:0}.scroll,pre{overflow:visible}details,article{break-inside:avoid}}
)";
}

}  // namespace rung
