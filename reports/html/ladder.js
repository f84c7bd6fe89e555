// A rung in a run: power, values, and why its coil has its value.

const kLeftRail = 0;

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
