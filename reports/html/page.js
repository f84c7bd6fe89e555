'use strict';
// The runs of a report. A run has one cursor over its ladder, its timing
// diagram and its scan table. A run's values are in the data island beside its
// table; a run is built when it comes into sight. Without this script the page
// has the table and the ladder of the last scan.

const kPlayMs = 700;  // a step
const kLeftRail = 0;

function html(name, attributes, ...children) {
  return fill(document.createElement(name), attributes, children);
}

function svg(name, attributes, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', name),
              attributes, children);
}

function fill(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

/** A rung's picture, and what its symbols were in each step. */
class Ladder {
  constructor(figure, states) {
    this.figure = figure;
    this.states = states;
    this.picture = figure.querySelector('svg');
    this.wires = [...this.picture.querySelectorAll('path[data-net]')];
    this.symbols = [...this.picture.querySelectorAll('g[data-kind]')].map(
        (group, index) => this.symbol(group, index));
    this.coil = this.symbols[this.symbols.length - 1];
    this.why = html('p', {class: 'why'});
    figure.append(this.why);
  }

  symbol(group, index) {
    const {kind, from, to, behind} = group.dataset;
    const name = group.querySelector('text').textContent;
    const value = group.querySelector('text.value');
    const title = svg('title', {});
    group.prepend(title);
    return {group, kind, name, value, title, index, behind: behind === '1',
            from: Number(from), to: Number(to)};
  }

  show(step, scan) {
    const power = this.states.power.map(steps => steps[step] === '1');
    const values = this.states.values.map(steps => steps[step]);
    for (const wire of this.wires) {
      wire.classList.toggle('on', power[wire.dataset.net]);
    }
    for (const symbol of this.symbols) {
      const value = values[symbol.index];
      symbol.value.textContent = value === null ? '-' : value;
      symbol.title.textContent = state(symbol, value);
      symbol.group.classList.remove('cause');
    }
    const why = this.explain(power, values);
    for (const symbol of why.causes) symbol.group.classList.add('cause');
    this.why.textContent = why.text;
    const name = this.figure.dataset.name;
    this.figure.querySelector('.when').textContent = ` in scan ${scan}`;
    this.picture.setAttribute(
        'aria-label', `rung ${name} at the end of scan ${scan}: ${why.text}`);
  }

  /** Why the coil has its value: the contacts that conduct, or do not. */
  explain(power, values) {
    const coil = this.coil;
    const value = values[coil.index];
    const on = power[coil.from];
    const said = symbol => state(symbol, values[symbol.index]);
    const causes = on ? this.conducting(power, values) :
                        this.blocking(power, values);
    const reasons = list(causes.path.map(said));
    const also = causes.others.length === 0 ? '' :
        `; another branch conducts too: ${list(causes.others.map(said))}`;
    let text = on ? `Power reaches ${coil.name}: ${reasons}${also}.` :
                    `No power reaches ${coil.name}: it stops at ${reasons}.`;
    if (on !== (value !== 0)) {
      text += ` ${coil.name} is ${value} at the scan's end: ` +
          'another rung writes it too.';
    }
    return {text, causes: causes.path};
  }

  /** From the coil back to the left rail, through what conducts. */
  conducting(power, values) {
    const path = [];
    const others = [];
    let net = this.coil.from;
    while (net !== kLeftRail && path.length < this.symbols.length) {
      const feeds = this.symbols.filter(
          s => s !== this.coil && s.to === net && values[s.index] !== null &&
              conducts(s, values[s.index]) && (s.behind || power[s.from]));
      if (feeds.length === 0) break;
      path.unshift(feeds[0]);
      others.push(...feeds.slice(1));
      if (feeds[0].behind) break;
      net = feeds[0].from;
    }
    return {path, others};
  }

  /** What has power in front of it and lets none through. */
  blocking(power, values) {
    const path = this.symbols.filter(
        s => s !== this.coil && !power[s.to] && (s.behind || power[s.from]) &&
            !conducts(s, values[s.index]));
    return {path, others: []};
  }
}

function conducts(symbol, value) {
  if (value === null) return false;
  return symbol.kind === 'negated' ? value === 0 : value !== 0;
}

/** "I0 = 1", of a box "IW0 < 20 is true". */
function state(symbol, value) {
  if (value === null) return `${symbol.name} is not executed`;
  if (symbol.kind === 'box' && (value === 0 || value === 1)) {
    return `${symbol.name} is ${value === 1 ? 'true' : 'false'}`;
  }
  const negated = symbol.kind === 'negated' ? ' (negated contact)' : '';
  return `${symbol.name} = ${value}${negated}`;
}

function list(texts) {
  if (texts.length < 2) return texts.join('');
  return texts.slice(0, -1).join(', ') + ' and ' + texts[texts.length - 1];
}

/** The signals over time: a line a bit, a band a word. */
class Timing {
  constructor(data, times, ends_badly) {
    this.ends_badly = ends_badly;
    this.row = 26;
    this.top = 18;
    this.x = [10];  // where each step begins; what stands before is the start
    for (const repeat of data.repeat) {
      this.x.push(this.x[this.x.length - 1] + (repeat > 1 ? 80 : 56));
    }
    const height = this.top + data.signals.length * this.row + 20;
    const width = this.x[this.x.length - 1] + 28;
    this.cursor = svg('rect', {class: 'cursor', y: 0, height});
    const names = data.signals.map(signal => signal.name).join(', ');
    this.plot = svg(
        'svg', {width, height, class: 'plot', role: 'img',
                'aria-label': `timing diagram of ${names}; the table has its values`},
        this.cursor, ...this.axis(data, times, height),
        ...data.signals.flatMap((signal, i) => this.signal(signal, i)));
    this.element = html(
        'div', {class: 'scroll timing', role: 'group', tabindex: 0,
                'aria-label': 'timing diagram'},
        this.names(data, height), this.plot);
  }

  y(index) { return this.top + index * this.row + this.row - 6; }

  names(data, height) {
    const longest = Math.max(...data.signals.map(s => [...s.name].length));
    const width = Math.min(20, longest) * 8 + 14;
    return svg(
        'svg', {width, height, class: 'names', 'aria-hidden': 'true'},
        ...data.signals.map((signal, i) => svg(
            'text', {x: width - 6, y: this.y(i) - 2, class: 'name'},
            [...signal.name].length > 20 ?
                [...signal.name].slice(0, 19).join('') + '…' : signal.name)));
  }

  axis(data, times, height) {
    const parts = [];
    let free = 0;
    data.repeat.forEach((repeat, i) => {
      const end = this.x[i + 1];
      parts.push(svg('path', {class: 'tick', d: `M${end} ${this.top}V${height - 16}`}));
      if (repeat > 1) {
        parts.push(svg('rect', {class: 'long', x: this.x[i], y: this.top,
                                width: end - this.x[i], height: height - this.top - 16}));
        parts.push(svg('text', {class: 'repeat', x: (this.x[i] + end) / 2, y: 12},
                       `×${repeat}`));
      }
      const half = times[i].length * 3.4;
      if (end - half < free) return;
      parts.push(svg('text', {class: 'time', x: end, y: height - 4}, times[i]));
      free = end + half + 4;
    });
    if (this.ends_badly) parts.push(...this.bad_end(height));
    return parts;
  }

  bad_end(height) {
    const x = this.x[this.x.length - 1];
    return [svg('path', {class: 'end', d: `M${x} ${this.top - 4}V${height - 16}`}),
            svg('text', {class: 'cross', x, y: 11}, '✗')];
  }

  signal(signal, index) {
    const low = this.y(index);
    const high = low - this.row + 11;
    return signal.word ? this.band(signal, low, high) :
                         [this.line(signal, low, high)];
  }

  line(signal, low, high) {
    const level = value => value === 0 ? low : high;
    const first =
        signal.kind === 'input' ? signal.values[0] : signal.initial;
    const points = [`0,${level(first)}`, `${this.x[0]},${level(first)}`];
    signal.values.forEach((value, i) => {
      points.push(`${this.x[i]},${level(value)}`,
                  `${this.x[i + 1]},${level(value)}`);
    });
    return svg('polyline', {class: 'bit', points: points.join(' ')});
  }

  band(signal, low, high) {
    const parts = [];
    for (let i = 0; i < signal.values.length;) {
      let end = i + 1;
      while (end < signal.values.length &&
             signal.values[end] === signal.values[i]) ++end;
      const [x, to, middle] = [this.x[i], this.x[end], (low + high) / 2];
      parts.push(svg('polyline', {class: 'bit', points:
          `${x},${middle} ${x + 3},${high} ${to - 3},${high} ${to},${middle} ` +
          `${to - 3},${low} ${x + 3},${low} ${x},${middle}`}));
      parts.push(svg('text', {class: 'word', x: (x + to) / 2, y: low - 3},
                     String(signal.values[i])));
      i = end;
    }
    return parts;
  }

  show(step) {
    this.cursor.setAttribute('x', this.x[step]);
    this.cursor.setAttribute('width', this.x[step + 1] - this.x[step]);
    const names = this.element.firstChild.getBoundingClientRect().width;
    scroll_to(this.element, 'Left', this.x[step],
              this.x[step + 1] - this.x[step] + names);
  }

  step_at(event) {
    const x = event.clientX - this.plot.getBoundingClientRect().left;
    const next = this.x.findIndex(begin => begin > x);
    return next === -1 ? this.x.length - 2 : Math.max(0, next - 1);
  }
}

/** Scrolls a box, not the page. */
function scroll_to(box, side, begin, size) {
  const scroll = `scroll${side}`;
  const extent = side === 'Left' ? box.clientWidth : box.clientHeight;
  if (begin < box[scroll] || begin + size > box[scroll] + extent) {
    box[scroll] = begin - Math.max(0, (extent - size) / 2);
  }
}

class Run {
  constructor(root) {
    this.root = root;
    this.obligation = root.closest('details').id;
    this.data = JSON.parse(root.querySelector('script').textContent);
    this.count = this.data.scan.length;
    this.rows = [...root.querySelectorAll('table.scans tbody tr')].slice(1);
    this.table = this.rows[0].closest('.scroll');
    this.step = this.count - 1;
    this.timer = null;
    this.ladders = this.make_ladders();
    const times = this.rows.map(row => row.cells[1].textContent);
    this.timing = new Timing(
        this.data, times, root.querySelector('.remark.bad') !== null);
    this.make_controls();
    root.prepend(this.controls, this.timing.element);
    this.listen();
    this.show(this.step);
  }

  make_ladders() {
    const file = this.obligation.replace(/-obligation-.*/, '');
    return this.data.rungs.flatMap(states => {
      const own = this.root.querySelector(`[data-rung="${states.rung}"]`);
      if (!own) return [];
      if (!own.querySelector('svg')) {
        const drawn = document.getElementById(`${file}-rung-${states.rung + 1}`);
        if (!drawn) return [];
        const box = own.querySelector('.scroll');
        box.replaceChildren(drawn.querySelector('svg').cloneNode(true));
      }
      return [new Ladder(own, states)];
    });
  }

  make_controls() {
    const button = (text, act) => {
      const element = html('button', {type: 'button'}, text);
      element.addEventListener('click', act);
      return element;
    };
    this.play_button = button('Play', () => this.play());
    this.range = html('input', {
      type: 'range', min: 1, max: this.count, 'aria-label': 'scan'});
    this.link = html('a', {}, 'link to this scan');
    this.live = html('output', {class: 'live'});
    this.controls = html(
        'div', {class: 'controls'},
        button('First', () => this.go(0)),
        button('Back', () => this.go(this.step - 1)), this.play_button,
        button('Next', () => this.go(this.step + 1)),
        button('Last', () => this.go(this.count - 1)), this.range, this.link,
        this.live);
  }

  listen() {
    this.root.tabIndex = 0;
    this.root.setAttribute('role', 'group');
    this.root.setAttribute('aria-label',
                           'run: left and right arrow, Home and End step');
    this.root.addEventListener('keydown', event => this.on_key(event));
    this.range.addEventListener('input', () => this.go(this.range.value - 1));
    this.timing.plot.addEventListener(
        'click', event => this.go(this.timing.step_at(event)));
    this.rows.forEach((row, i) => {
      row.addEventListener('click', () => this.go(i));
    });
  }

  on_key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    const target = event.target;
    if (target === this.range) return;
    const to = {ArrowLeft: this.step - 1, ArrowRight: this.step + 1, Home: 0,
                End: this.count - 1}[event.key];
    // What is wider than the window is scrolled with the arrows.
    const scrolls = target.classList.contains('scroll') &&
        target.scrollWidth > target.clientWidth;
    if (to !== undefined && !scrolls) {
      this.go(to);
    } else if (event.key === ' ' && target === this.root) {
      this.play();
    } else {
      return;
    }
    event.preventDefault();
  }

  /** Where the reader wants to be: playing ends. */
  go(step) {
    this.pause();
    this.show(Math.min(Math.max(step, 0), this.count - 1));
  }

  play() {
    if (this.timer !== null) {
      this.pause();
      return;
    }
    if (this.step === this.count - 1) this.show(this.data.loop ?? 0);
    this.play_button.textContent = 'Pause';
    this.timer = setInterval(() => this.tick(), kPlayMs);
  }

  tick() {
    const at_end = this.step === this.count - 1;
    if (at_end && this.data.loop !== undefined) {
      this.show(this.data.loop);
    } else {
      this.show(Math.min(this.step + 1, this.count - 1));
    }
    const over = this.step === this.count - 1 && this.data.loop === undefined;
    if (over) this.pause();
  }

  pause() {
    clearInterval(this.timer);
    this.timer = null;
    this.play_button.textContent = 'Play';
  }

  show(step) {
    this.step = step;
    const scan = this.data.scan[step];
    this.rows.forEach((row, i) => {
      if (i === step) row.setAttribute('aria-current', 'step');
      else row.removeAttribute('aria-current');
    });
    const row = this.rows[step];
    scroll_to(this.table, 'Top', row.offsetTop, row.offsetHeight);
    this.timing.show(step);
    for (const ladder of this.ladders) ladder.show(step, scan);
    this.range.value = step + 1;
    this.range.setAttribute('aria-valuetext', `scan ${scan}`);
    this.link.href = `#${this.obligation}&scan=${scan}`;
    this.live.textContent = this.words(step);
  }

  /** "Scan 2, 200 ms. Changed: I0 = 0. I1 = 1, Q0 = 1." */
  words(step) {
    const changed = [];
    const same = [];
    for (const signal of this.data.signals) {
      const value = signal.values[step];
      const before = step === 0 ? signal.initial : signal.values[step - 1];
      const text = `${signal.name} = ${value}`;
      (value === before ? same : changed).push(text);
    }
    const head = `Scan ${this.data.scan[step]}, ` +
        `${this.rows[step].cells[1].textContent}.`;
    const news = changed.length > 0 ? ` Changed: ${changed.join(', ')}.` :
                                      ' Nothing changed.';
    return head + news + (same.length > 0 ? ` ${same.join(', ')}.` : '');
  }

  /** The step that scan number `scan` is in. */
  step_of(scan) {
    const step = this.data.scan.findIndex(last => last >= scan);
    return step === -1 ? this.count - 1 : step;
  }
}

const runs = new Map();  // by their element

function run_of(root) {
  if (!runs.has(root)) runs.set(root, new Run(root));
  return runs.get(root);
}

/** `#file-1-obligation-2&scan=3` */
function follow_link() {
  const parts = location.hash.slice(1).split('&');
  const details = document.getElementById(parts[0]);
  if (!details || details.localName !== 'details') return;
  details.open = true;
  const root = details.querySelector('.run');
  const scan = parts.find(part => /^scan=\d+$/.test(part));
  if (root && root.querySelector('script')) {
    if (scan) run_of(root).go(run_of(root).step_of(Number(scan.slice(5))));
    run_of(root).root.focus({preventScroll: true});
  }
  details.scrollIntoView();
}

const all_runs = [...document.querySelectorAll('.run')].filter(
    root => root.querySelector('script'));
const observer = new IntersectionObserver(entries => {
  for (const entry of entries) {
    if (entry.isIntersecting) run_of(entry.target);
  }
}, {rootMargin: '400px'});
all_runs.forEach(root => observer.observe(root));
addEventListener('hashchange', follow_link);
addEventListener('beforeprint', () => {
  for (const root of all_runs) {
    const details = root.closest('details');
    if (details.classList.contains('violated')) details.open = true;
    if (details.open) run_of(root);
  }
});
follow_link();
