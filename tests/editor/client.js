// Usage: node client.js RUNGPROOF
// A session of an editor with `rungproof lsp`, by the protocol library that
// editors use.
'use strict';
const assert = require('assert');
const {spawn} = require('child_process');
const {
  createProtocolConnection, StreamMessageReader, StreamMessageWriter,
  CancellationToken, CancellationTokenSource,
} = require('vscode-languageserver-protocol/node');

const program = process.argv[2];

class Client {
  constructor(capabilities = {}) {
    this.child = spawn(program, ['lsp', '--stdio'],
                       {stdio: ['pipe', 'pipe', 'inherit']});
    this.exited = new Promise(done => this.child.on('exit', done));
    this.connection = createProtocolConnection(
        new StreamMessageReader(this.child.stdout),
        new StreamMessageWriter(this.child.stdin));
    this.published = [];
    this.waiting = [];
    this.progress = [];
    this.refreshes = 0;
    this.connection.onNotification('textDocument/publishDiagnostics', it => {
      this.published.push(it);
      this.waiting = this.waiting.filter(wait => !wait(it));
    });
    this.connection.onRequest('workspace/codeLens/refresh',
                              () => { ++this.refreshes; return null; });
    this.connection.onRequest('window/workDoneProgress/create', () => null);
    this.connection.onNotification('$/progress', it => {
      this.progress.push(it.value.kind);
      if (it.value.kind === 'begin' && this.onBegin) this.onBegin();
    });
    this.connection.onNotification('window/showMessage', () => {});
    this.connection.listen();
    this.ready = this.connection.sendRequest('initialize', {
      processId: null, rootUri: null, capabilities,
      initializationOptions: {proofSeconds: 60},
    });
  }

  async start() {
    const answer = await this.ready;
    this.connection.sendNotification('initialized', {});
    return answer;
  }

  // Diagnostics of that version of the document.
  diagnostics(uri, version) {
    const fits = it => it.uri === uri && it.version === version;
    const known = this.published.filter(fits).pop();
    if (known) return Promise.resolve(known.diagnostics);
    return new Promise(done => this.waiting.push(it => {
      if (!fits(it)) return false;
      done(it.diagnostics);
      return true;
    }));
  }

  // The next proof is under way.
  begun() { return new Promise(done => this.onBegin = done); }

  open(uri, text) {
    this.connection.sendNotification('textDocument/didOpen', {
      textDocument: {uri, languageId: 'rung', version: 1, text}});
    return this.diagnostics(uri, 1);
  }

  change(uri, version, contentChanges) {
    this.connection.sendNotification('textDocument/didChange', {
      textDocument: {uri, version}, contentChanges});
    return this.diagnostics(uri, version);
  }

  ask(method, uri, more = {}) {
    return this.connection.sendRequest(
        method, {textDocument: {uri}, ...more});
  }

  async stop() {
    await this.connection.sendRequest('shutdown');
    this.connection.sendNotification('exit');
    assert.strictEqual(await this.exited, 0);
  }
}

const at = (line, character) => ({line, character});
const codes = diagnostics => diagnostics.map(it => it.code);
const titles = lenses => lenses.map(it => it.command.title);

// Whoever sends it applies the edits as well.
function apply(text, edits) {
  const lines = text.split('\n');
  const offset = p => lines.slice(0, p.line).join('\n').length +
      (p.line > 0 ? 1 : 0) + p.character;
  return [...edits]
      .sort((a, b) => offset(b.range.start) - offset(a.range.start))
      .reduce((now, edit) => now.slice(0, offset(edit.range.start)) +
                  edit.newText + now.slice(offset(edit.range.end)), text);
}

const kMotor = `//@ stop: always I1 -> !Q0
//@ never-on: never Q0
Q0 = (I0 || Q0) && !I1;
`;

async function diagnosticsAsOneTypes() {
  const client = new Client();
  const {capabilities} = await client.start();
  assert.strictEqual(capabilities.positionEncoding, 'utf-16');
  const uri = 'file:///work/motor.rung';
  assert.deepStrictEqual(await client.open(uri, kMotor), []);
  // A syntax error is all that is told.
  let found = await client.change(uri, 2, [
    {range: {start: at(2, 22), end: at(2, 23)}, text: ' &&\nQ1 = Q1;'}]);
  assert.deepStrictEqual(codes(found), ['RP010']);
  assert.strictEqual(found[0].severity, 1);
  // Two changes in one message, one behind the other.
  found = await client.change(uri, 3, [
    {range: {start: at(2, 22), end: at(2, 25)}, text: ';'},
    {range: {start: at(3, 0), end: at(3, 0)}, text: '/* \u{1d11e} */ '}]);
  const self = found.find(it => it.data.rule === 'self-assignment');
  assert.deepStrictEqual(self.range, {start: at(3, 9), end: at(3, 16)});
  assert.deepStrictEqual(self.tags, [1]);
  // The whole text anew.
  assert.deepStrictEqual(await client.change(uri, 4, [{text: kMotor}]), []);
  client.connection.sendNotification('textDocument/didClose',
                                     {textDocument: {uri}});
  await assert.rejects(client.ask('textDocument/codeLens', uri));
  await client.stop();
}

async function proofs() {
  const client = new Client({
    workspace: {codeLens: {refreshSupport: true}},
    window: {workDoneProgress: true}});
  await client.start();
  const uri = 'file:///work/motor.rung';
  await client.open(uri, kMotor);
  const lenses = () => client.ask('textDocument/codeLens', uri);
  const hover = async (line, character) =>
      (await client.ask('textDocument/hover', uri,
                        {position: at(line, character)})).contents.value;
  const run = (command, ...names) => client.connection.sendRequest(
      'workspace/executeCommand', {command, arguments: [uri, ...names]});
  assert.deepStrictEqual(titles(await lenses()),
                         ['Prove all', 'Prove', 'Prove']);
  assert.match(await hover(0, 5), /not proved yet/);

  const one = await run('rungproof.prove', 'stop');
  assert.deepStrictEqual(one.results.map(it => [it.name, it.verdict]),
                         [['stop', 'proved']]);
  assert.match(titles(await lenses())[1], /^PROVED \(.*, \d+\.\d\d s\)$/);
  assert.strictEqual(titles(await lenses())[2], 'Prove');

  await run('rungproof.prove');
  const after = titles(await lenses());
  assert.match(after[2], /^VIOLATED/);
  assert.strictEqual(after[3], 'Show counterexample');
  assert.match(await run('rungproof.showCounterexample', 'never-on'),
               /scan 1[^]*I0[^]*Q0/);
  assert.match(await hover(1, 5), /VIOLATED[^]*scan/);
  const told = client.published[client.published.length - 1];
  assert.deepStrictEqual(codes(told.diagnostics), ['property-violated']);
  assert.ok(client.progress.includes('begin') &&
            client.progress.includes('end'));
  assert.ok(client.refreshes > 0);
  await assert.rejects(run('rungproof.prove', 'no-such'), /no such property/);
  await assert.rejects(run('rungproof.showCounterexample', 'stop'));
  await assert.rejects(run('rungproof.dance'), /no such command/);
  assert.match(await client.connection.sendRequest(
                   'workspace/executeCommand',
                   {command: 'rungproof.showRule', arguments: ['RP101']}),
               /## Finds/);

  // What was proved of another text is not shown of this one.
  await client.change(uri, 2, [
    {range: {start: at(2, 19), end: at(2, 22)}, text: '(!I1 || I2)'}]);
  assert.deepStrictEqual(titles(await lenses()),
                         ['Prove all', 'Prove', 'Prove']);
  await assert.rejects(run('rungproof.showCounterexample', 'never-on'));
  await client.stop();
}

async function cancellation() {
  const client = new Client({window: {workDoneProgress: true}});
  await client.start();
  const uri = 'file:///work/hard.rung';
  // Many independent counters: too many states for the minute that it has.
  let text = '//@ hard: never M0 && M1 && M2 && M3 && M4 && M5 && M6 && M7\n';
  for (let i = 0; i < 8; ++i) {
    text += `M${i} = C(${i}, ${90 + 7 * i}, I${i % 4} && !M${(i + 1) % 8}, ` +
        `I${(i + 1) % 4} && M${(i + 3) % 8}, I5);\n`;
  }
  await client.open(uri, text);
  const run = (token = CancellationToken.None) => client.connection.sendRequest(
      'workspace/executeCommand',
      {command: 'rungproof.prove', arguments: [uri, 'hard']}, token);
  const source = new CancellationTokenSource();
  const first = assert.rejects(run(source.token), {code: -32800});
  await client.begun();
  source.cancel();
  await first;
  // A change of the text ends a proof as well.
  const second = assert.rejects(run(), {code: -32801});
  await client.begun();
  await client.change(uri, 2, [
    {range: {start: at(0, 0), end: at(0, 0)}, text: '\n'}]);
  await second;
  await client.stop();
}

async function names() {
  const client = new Client({
    general: {positionEncodings: ['utf-8', 'utf-16']}});
  const {capabilities} = await client.start();
  assert.strictEqual(capabilities.positionEncoding, 'utf-8');
  const uri = 'file:///work/names.rung';
  const text = `//@ M0: always M0 -> I0
M0 = I0 && !I1; Q0 = M0 || Q0 && !I1;
//Var
M0 = false;
//Sim
if (M0) x = 1;
`;
  await client.open(uri, text);
  const symbols = await client.ask('textDocument/documentSymbol', uri);
  assert.deepStrictEqual(symbols.map(it => it.name), ['M0', 'M0', 'Q0']);
  const here = {position: at(1, 21)};
  const definition = await client.ask('textDocument/definition', uri, here);
  assert.deepStrictEqual(definition.map(it => it.range.start), [at(1, 0)]);
  const references = await client.ask(
      'textDocument/references', uri,
      {...here, context: {includeDeclaration: true}});
  assert.deepStrictEqual(
      references.map(it => it.range.start),
      [at(0, 15), at(1, 0), at(1, 21), at(3, 0), at(5, 4)]);
  assert.deepStrictEqual(
      await client.ask('textDocument/prepareRename', uri, here),
      {start: at(1, 21), end: at(1, 23)});
  const rename = newName =>
      client.ask('textDocument/rename', uri, {...here, newName});
  const edit = await rename('ready');
  assert.strictEqual(
      apply(text, edit.changes[uri]),
      text.replace(/M0(?!:)/g, 'ready'));
  for (const bad of ['I0', 'Q0', 'Q5', 'I7', '', '1x', 'a b', 'true', 'while',
                     'x', 'T', '&&', 'M0', 'a=1;b']) {
    await assert.rejects(rename(bad), undefined, `"${bad}" was accepted`);
  }
  await client.stop();
}

async function quickFixes() {
  const client = new Client();
  await client.start();
  const uri = 'file:///work/fixes.rung';
  const text = 'Q0 = (I0 || Q0) && !I1 && true; // kept\n' +
      '  Q1 = Q1 || I2;\n';
  await client.open(uri, text);
  const actions = async line => client.ask('textDocument/codeAction', uri, {
    range: {start: at(line, 0), end: at(line, 40)},
    context: {diagnostics: []}});
  // Whether they are proved is known soon.
  let all = await actions(0);
  while (/not proved yet/.test(all[0].title)) {
    await new Promise(done => setTimeout(done, 20));
    all = await actions(0);
  }
  assert.deepStrictEqual(all.map(it => it.title), [
    'remove `true` (proved: the program does the same)',
    'allow constant-operand here (write the reason)']);
  assert.deepStrictEqual(all.map(it => it.isPreferred), [true, false]);
  const fixed = apply(text, all[0].edit.changes[uri]);
  assert.strictEqual(fixed.split('\n')[0],
                     'Q0 = (I0 || Q0) && !I1; // kept');
  const [stop, allow] = await actions(1);
  assert.match(stop.title, /add a stop contact.*changes what/);
  assert.ok(!stop.isPreferred);
  // Without a reason it allows nothing, and that is said.
  let found = await client.change(uri, 2, [
    {text: apply(text, allow.edit.changes[uri])}]);
  assert.ok(found.some(it => it.data.rule === 'allow-without-reason'));
  found = await client.change(uri, 3, [
    {text: apply(text, allow.edit.changes[uri]).replace(
        'set-without-reset: ', 'set-without-reset: for good')}]);
  assert.deepStrictEqual(codes(found), ['RP302']);
  await client.stop();
}

async function main() {
  for (const test of [diagnosticsAsOneTypes, proofs, cancellation, names,
                      quickFixes]) {
    await test();
    console.log(`ok ${test.name}`);
  }
}

main().then(() => process.exit(0), error => {
  console.error(error);
  process.exit(1);
});
