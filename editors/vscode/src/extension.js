'use strict';
const vscode = require('vscode');
const {LanguageClient} = require('vscode-languageclient/node');

let client;

/// What violates a property opens beside the program.
async function showText(text) {
  const document = await vscode.workspace.openTextDocument(
      {content: text, language: 'plaintext'});
  await vscode.window.showTextDocument(
      document, {viewColumn: vscode.ViewColumn.Beside, preview: true});
}

function createClient() {
  const settings = vscode.workspace.getConfiguration('rungproof');
  const server = {
    command: settings.get('path'),
    args: ['lsp', '--stdio', ...settings.get('arguments')],
  };
  return new LanguageClient('rungproof', 'Rungproof', server, {
    documentSelector: [{language: 'rung'}],
    initializationOptions: {proofSeconds: settings.get('proofSeconds')},
    middleware: {
      executeCommand: async (command, args, next) => {
        const result = await next(command, args);
        if (command === 'rungproof.showCounterexample' &&
            typeof result === 'string') {
          await showText(result);
        }
        return result;
      },
    },
  });
}

async function restart() {
  if (client) await client.stop();
  client = createClient();
  await client.start();
}

exports.activate = async context => {
  context.subscriptions.push(
      vscode.commands.registerCommand('rungproof.restart', restart),
      vscode.workspace.onDidChangeConfiguration(async change => {
        if (change.affectsConfiguration('rungproof')) await restart();
      }));
  await restart();
};

exports.deactivate = () => client && client.stop();
