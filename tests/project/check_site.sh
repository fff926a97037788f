#!/bin/bash
# The documentation becomes a site by one command, and no link in it leads nowhere. Every option in the driver's help has its
# section, and every option in the tables of the driver's page leads to it.
#   check_site.sh <source directory> <work directory> [driver]     by default the driver of scripts/site; without one no options
set -euo pipefail
driver=${3:+$(realpath "$3")}
cd "$1"
work=$2
page=$(scripts/site "$work" "$driver")
[[ -s $page ]] || { echo "there is no $page"; exit 1; }
html=$(dirname "$page")
for wanted in library building driver simplification not_in_it concepts/improver source/examples/08_thresholds.cpp \
    reference/index reference/pipeline/generate reference/mesher/concepts; do
  [[ -s $html/$wanted.html ]] || { echo "there is no page $wanted"; exit 1; }
done
# Every link, and what follows a # in it, in pages made from Markdown and in what is given as HTML.
python3 - "$html" <<'END'
import pathlib, re, sys, urllib.parse
html = pathlib.Path(sys.argv[1])
text = {page: page.read_text() for page in html.rglob("*.html")}
anchors = {page.resolve(): set(re.findall(r'\bid="([^"]+)"', content)) for page, content in text.items()}
problems = set()
for page, content in text.items():
    ids = re.findall(r'\bid="([^"]+)"', content)
    if "reference" in page.parts and len(ids) != len(set(ids)):
        problems.add(f"{page.relative_to(html)}: an anchor is there twice")
    for link in re.findall(r'href="([^"]*)"', content):
        if re.match(r"[a-z]+:|/", link):
            continue
        file, _, anchor = urllib.parse.unquote(link).partition("#")
        target = (page.parent / file).resolve() if file else page.resolve()
        target = target / "index.html" if target.is_dir() else target
        if not target.exists():
            problems.add(f"{page.relative_to(html)}: {link} does not exist")
        elif anchor and target in anchors and anchor not in anchors[target]:
            problems.add(f"{page.relative_to(html)}: {link}: there is no such anchor")
print("\n".join(sorted(problems)))
sys.exit(bool(problems))
END

driver=${driver:-build/app/dovetail}
[[ -x $driver ]] || { echo "without $driver options are not checked"; exit 0; }
python3 - "$html" "$driver" <<'END'
import pathlib, re, subprocess, sys
pages, driver = pathlib.Path(sys.argv[1]), sys.argv[2]


def help_of(*command):
    return subprocess.run([driver, *command, "--help"], check=True, capture_output=True, text=True).stdout


wanted = {}  # page -> options, as the help has them
for command in ["", *re.findall(r"^  ([a-z]+) ", help_of().partition("\nSubcommands:")[2].partition("\n\n")[0], re.M)]:
    wanted[command or "dovetail"] = re.findall(r"^  ((?:-\w,)?--[\w-]+)", help_of(*command.split()), re.M)
if sum(map(len, wanted.values())) < 100:
    sys.exit(f"only {sum(map(len, wanted.values()))} options were found in the help")


def faults(text_of):
    for page, options in wanted.items():
        text = text_of(page)
        for names in options:
            name = names.split(",")[-1]
            found = re.search(rf'<h2 id="{name[2:]}">(.*?)</h2>(.*?)(?=<h2|$)', text, re.S)
            heading, section = (found[1], found[2]) if found else ("", "")
            if not all(f"<code>{each}</code>" in heading for each in names.split(",")):
                yield f"options/{page}: there is no section of {names}"
            elif not re.search(r"<p>\w", section) or not re.search(r"Argument</strong>: .+?<strong>Default</strong>: \S", section):
                yield f"options/{page}: meaning, argument or default of {name} is missing"


made = {page: (pages / f"reference/options/{page}.html").read_text() for page in wanted}
problems = list(faults(made.get))
# What the check is worth: without a section, or with an empty one, it has to fail.
section = re.compile(r'<h2 id="order">.*?(?=<h2)', re.S)
for broken in ("", '<h2 id="order"><code>--order</code></h2>'):
    if len(list(faults({**made, "mesh": section.sub(broken, made["mesh"])}.get))) != 1:
        problems.append("a missing or empty section of --order is no fault")
for cell in re.findall(r"<tr>\s*<td>(.*?)</td>", (pages / "driver.html").read_text(), re.S):
    for name in re.findall(r"--[a-z-]+", re.sub(r"<a href=.*?</a>", "", cell)):
        problems.append(f"driver: {name} in a table leads nowhere")
print("\n".join(problems))
sys.exit(bool(problems))
END
