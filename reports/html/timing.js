// A run's timing diagram.

/** The signals over time: a line a bit, a band a word. */
class Timing {
  /** Few lines are spread over `room` pixels. */
  constructor(data, times, ends_badly, room) {
    this.ends_badly = ends_badly;
    const unit = Math.max(56, Math.min(140, Math.floor(room / times.length)));
    this.row = 26;
    this.top = 18;
    this.x = [10];  // where each step begins; what stands before is the start
    for (const repeat of data.repeat) {
      this.x.push(this.x[this.x.length - 1] + (repeat > 1 ? unit + 24 : unit));
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
      if (end - 4 - times[i].length * 6.8 < free) return;
      parts.push(svg('text', {class: 'time', x: end - 4, y: height - 4}, times[i]));
      free = end;
    });
    if (this.ends_badly) parts.push(...this.bad_end(height));
    return parts;
  }

  bad_end(height) {
    const x = this.x[this.x.length - 1];
    return [svg('path', {class: 'end', d: `M${x} ${this.top - 4}V${height - 16}`}),
            svg('text', {class: 'cross', x: x + 4, y: 15}, '✗')];
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
