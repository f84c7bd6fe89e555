// Workflow commands, read as GitHub's runner reads them (ActionCommand.cs and
// IssueCommandExtension of actions/runner): what it would drop is a problem.
'use strict';

const UNESCAPE = [['%0D', '\r'], ['%0A', '\n'], ['%25', '%']];
const UNESCAPE_PROPERTY =
    [['%0D', '\r'], ['%0A', '\n'], ['%3A', ':'], ['%2C', ','], ['%25', '%']];

function unescaped(text, pairs) {
  for (const [code, letter] of pairs) text = text.split(code).join(letter);
  return text;
}

// {command, properties, message}, or null where the runner sees plain text.
function parse(line) {
  if (!line.startsWith('::')) return null;
  const end = line.indexOf('::', 2);
  if (end < 0) return null;
  const info = line.slice(2, end);
  const space = info.indexOf(' ');
  const command = space < 0 ? info : info.slice(0, space);
  const properties = {};
  for (const one of space < 0 ? [] : info.slice(space + 1).split(',')) {
    const equals = one.indexOf('=');
    if (equals <= 0) return null;
    properties[one.slice(0, equals).trim()] =
        unescaped(one.slice(equals + 1), UNESCAPE_PROPERTY);
  }
  return {
    command,
    properties,
    message: unescaped(line.slice(end + 2), UNESCAPE),
  };
}

function problem(line) {
  const parsed = parse(line);
  if (parsed === null) return 'is no workflow command';
  if (!['error', 'warning', 'notice'].includes(parsed.command)) {
    return `has the command ${parsed.command}`;
  }
  if (parsed.message.trim() === '') return 'has no message';
  const {file, line: first, endLine, col, endColumn} = parsed.properties;
  const known = ['file', 'line', 'endLine', 'col', 'endColumn', 'title'];
  for (const key of Object.keys(parsed.properties)) {
    if (!known.includes(key)) return `has the property ${key}`;
  }
  const numbers = [first, endLine, col, endColumn].filter(n => n !== undefined);
  if (!numbers.every(n => /^[1-9][0-9]*$/.test(n))) return 'has a bad number';
  if (first !== undefined && !file) return 'has a line of no file';
  if (endLine !== undefined && Number(endLine) < Number(first)) {
    return 'ends before it begins';
  }
  if (col !== undefined && endLine !== undefined && endLine !== first) {
    return 'has columns of two lines';
  }
  if (endColumn !== undefined && Number(endColumn) < Number(col)) {
    return 'ends in a column before it begins';
  }
  return null;
}

// The lines of a report that the runner would not take as they are.
function problems(text) {
  const found = [];
  const lines = text.split('\n');
  if (lines.pop() !== '') found.push('the last line is not ended');
  if (lines.length === 0) found.push('it is empty');
  for (const line of lines) {
    const what = problem(line);
    if (what !== null) found.push(`${what}: ${line}`);
  }
  return found;
}

module.exports = {problems};
