// The runs of a report. A run has one cursor over its ladder, its timing
// diagram and its scan table. A run's values are in the data island beside its
// table; a run is built when it comes into sight. Without this script the page
// has the table and the ladder of the last scan.

const kPlayMs = 700;  // a step

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
    this.times = this.rows.map(row => row.cells[1].textContent);
    this.timing = new Timing(
        this.data, this.times, root.querySelector('.remark.bad') !== null,
        root.clientWidth - 240);
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
        button('Save JSON', () => this.save('json')),
        button('Save WaveJSON', () => this.save('wavejson')),
        this.live);
  }

  save(format) {
    const name = `${this.obligation}.${format}`;
    const title = this.root.closest('details').querySelector('code').textContent;
    save(name, format === 'json' ? this.data :
                                   wavejson(this.data, title, this.times));
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
