"""Usage: ci_files.py PROGRAM ROOT

action.yml, .pre-commit-hooks.yaml, Dockerfile and docs/ci.md: that they parse,
name commands, options and files that exist, and that what they run does what
they say. The image is not made here: a docker of ours runs PROGRAM instead.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("SKIPPED: python3-yaml is missing: the files for CI were NOT checked")
    sys.exit(1 if os.environ.get("CI") else 77)

program = pathlib.Path(sys.argv[1]).resolve()
root = pathlib.Path(sys.argv[2]).resolve()
problems = []


def expect(good, what):
    if not good:
        problems.append(what)


def run(command, **more):
    return subprocess.run(
        command, text=True, capture_output=True, check=False, **more
    )


def text_of(name):
    return (root / name).read_text(encoding="utf-8")


def known_words():
    """The commands and the options that PROGRAM has."""
    text = run([program, "--help"]).stdout
    commands = re.findall(
        r"^  ([a-z]+) ", text[text.index("Subcommands:"):], re.M)
    for command in commands:
        text += run([program, command, "--help"]).stdout
    return set(commands), set(re.findall(r"--[a-z][a-z-]+", text))


COMMANDS, OPTIONS = known_words()


def check_command(line, where):
    """A line that begins with `rungproof`."""
    words = line.split()
    expect(words[1] in COMMANDS, f"{where}: there is no command {words[1]}")
    for option in re.findall(r"(?<!\S)--[a-z][a-z-]+", line):
        expect(option in OPTIONS, f"{where}: there is no option {option}")


def check_docs():
    text = text_of("docs/ci.md")
    blocks = re.findall(r"^```yaml\n(.*?)^```", text, re.M | re.S)
    expect(len(blocks) == 3, "docs/ci.md: three files of YAML")
    for block in blocks:
        yaml.safe_load(block)
    for line in re.findall(r"`(rungproof [a-z][^`]*)`", text):
        check_command(line, "docs/ci.md")
    for line in re.findall(r"- (rungproof .*)", text):
        check_command(line, "docs/ci.md")
    hooks = {one["id"] for one in yaml.safe_load(text_of(HOOKS))}
    used = [h["id"] for r in yaml.safe_load(blocks[2])["repos"] for h in r["hooks"]]
    expect(set(used) <= hooks, "docs/ci.md: a hook that there is not")
    inputs = yaml.safe_load(text_of("action.yml"))["inputs"]
    step = yaml.safe_load(blocks[0])["jobs"]["check"]["steps"][1]
    expect(set(step["with"]) <= set(inputs), "docs/ci.md: inputs of the action")
    for option in re.findall(r"--[a-z-]+", step["with"]["options"]):
        expect(option in OPTIONS, f"docs/ci.md: there is no option {option}")


HOOKS = ".pre-commit-hooks.yaml"


def check_hooks(folder):
    for hook in yaml.safe_load(text_of(HOOKS)):
        check_command(hook["entry"], HOOKS)
        files = re.compile(hook["files"])
        for name in ("a.rung", "b/c.st", "d.IL".lower(), "e.L5X", "f.l5x",
                     "g.ld", "h.ino", "i.awl"):
            expect(files.search(name), f"{hook['id']}: {name} is left out")
        for name in ("a.rung.txt", "rung", "a.md"):
            expect(not files.search(name), f"{hook['id']}: {name} is read")
        if hook["language"] != "system":
            continue
        path = f"{program.parent}:{os.environ['PATH']}"
        for name, status in (("good.rung", 0), ("bad.rung", 1)):
            done = run([*hook["entry"].split(), name], cwd=folder,
                       env={**os.environ, "PATH": path})
            expect(done.returncode == status, f"{hook['id']}: {name}: {done}")


def check_dockerfile():
    text = text_of("Dockerfile")
    for script in re.findall(r"scripts/\S+", text):
        expect((root / script).exists(), f"Dockerfile: {script}")
    option = re.search(r"scripts/deps (--\w+)", text).group(1)
    expect(f"{option}) wanted=" in text_of("scripts/deps"), "scripts/deps")
    presets = json.loads(text_of("CMakePresets.json"))
    names = [one["name"] for one in presets["configurePresets"]]
    for preset in re.findall(r"--preset (\S+)", text):
        expect(preset in names, f"Dockerfile: the preset {preset}")
    expect('ENTRYPOINT ["rungproof"]' in text, "Dockerfile: its entry point")


def action_steps(folder, **inputs):
    """Runs the action as a runner would; its last step's outcome."""
    action = yaml.safe_load(text_of("action.yml"))
    values = {k: v.get("default", "") for k, v in action["inputs"].items()}
    values.update(inputs)
    docker = folder / "bin" / "docker"
    docker.parent.mkdir(exist_ok=True)
    docker.write_text(
        "#!/bin/bash\n"
        'if [ "$1" = build ]; then exit 0; fi\n'
        "shift; while [[ $1 == --* ]]; do\n"
        '  if [ "$1" = --rm ]; then shift; else shift 2; fi\n'
        "done\n"
        f'shift; cd "$GITHUB_WORKSPACE" && exec {program} "$@"\n')
    docker.chmod(0o755)
    env = {**os.environ, "GITHUB_WORKSPACE": str(folder),
           "GITHUB_ACTION_PATH": str(root),
           "PATH": f"{docker.parent}:{os.environ['PATH']}"}
    for step in action["runs"]["steps"]:
        for key, value in step.get("env", {}).items():
            name = re.fullmatch(r"\$\{\{ inputs\.(\w+) \}\}", value).group(1)
            env[key] = values[name]
        done = run(["bash", "-eo", "pipefail", "-c", step["run"]], env=env)
        if done.returncode != 0:
            break
    return done


def check_action(folder):
    done = action_steps(folder, command="lint", files="good.rung bad.rung")
    expect(done.returncode == 1, f"action: the status: {done}")
    expect("::warning file=bad.rung,line=1" in done.stdout, f"action: {done}")
    sarif = json.loads((folder / "rungproof.sarif").read_text())
    expect(len(sarif["runs"][0]["results"]) == 1, "action: the SARIF report")
    done = action_steps(folder, command="lint", files="bad.rung", sarif="",
                        options="--rule set-without-reset=off --pack default")
    expect(done.returncode == 0, f"action: its options: {done}")
    done = action_steps(folder, files="*.rung")
    expect(done.returncode == 2, f"action: a star is a star: {done}")


with tempfile.TemporaryDirectory() as name:
    here = pathlib.Path(name)
    (here / "good.rung").write_text("Q0 = I0;\n")
    (here / "bad.rung").write_text("Q0 = Q0 || I0;\n")
    check_docs()
    check_hooks(here)
    check_dockerfile()
    check_action(here)
for problem in problems:
    print(problem, file=sys.stderr)
print(f"the files for CI: {len(problems)} problems")
sys.exit(1 if problems else 0)
