"""Runs an example. Where a tutorial shows its output, between "<!-- output of NAME -->" and "<!-- end of output -->", the
output must be that: the same words, and numbers within a fifth (other compilers make other meshes).
Usage: check_output.py [--update] TUTORIALS NAME PROGRAM [ARGUMENTS...]"""
import pathlib
import re
import subprocess
import sys

update = sys.argv[1] == "--update"
folder, name, *command = sys.argv[2 if update else 1 :]
run = subprocess.run(command, capture_output=True, text=True)
sys.stdout.write(run.stdout)
sys.stderr.write(run.stderr)
if run.returncode:
    sys.exit(run.returncode)

block = re.compile(rf"(<!-- output of {re.escape(name)} -->\n```text\n)(.*?)(```\n<!-- end of output -->)", re.S)
number = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def same(shown, found):
    if number.sub("#", shown).split() != number.sub("#", found).split():
        return False
    pairs = zip(map(float, number.findall(shown)), map(float, number.findall(found)))
    return all(abs(a - b) <= 0.2 * max(abs(a), abs(b)) for a, b in pairs)


for page in sorted(pathlib.Path(folder).glob("*.md")):
    text = page.read_text()
    if update:
        page.write_text(block.sub(lambda at: at[1] + run.stdout + at[3], text))
    elif any(not same(at[2], run.stdout) for at in block.finditer(text)):
        sys.exit(f"{page} shows another output of {name}")
