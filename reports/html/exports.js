// A run as a file. `prove --traces` writes more, and more exactly.

/** For WaveDrom: a character a line of the table. */
function wavejson(data, title, times) {
  const lane = signal => {
    const words = [];
    const wave = signal.values.map((value, i) => {
      if (i > 0 && value === signal.values[i - 1]) {
        return data.repeat[i] > 1 ? '|' : '.';
      }
      if (!signal.word) return String(value);
      words.push(String(value));
      return '=';
    });
    return {name: signal.name, wave: wave.join(''), data: words};
  };
  const clock = {name: 'time', wave: '='.repeat(times.length), data: times};
  return {signal: [clock, ...data.signals.map(lane)], head: {text: title}};
}

/** Saves a value as JSON; nothing is sent anywhere. */
function save(name, value) {
  const text = JSON.stringify(value, null, 2);
  const url = URL.createObjectURL(new Blob([text], {type: 'application/json'}));
  html('a', {href: url, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(url), 0);
}
