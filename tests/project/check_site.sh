#!/bin/bash
# The documentation becomes a site by one command, and no link in it leads nowhere.
#   check_site.sh <source directory> <work directory>
set -euo pipefail
cd "$1"
work=$2
page=$(scripts/site "$work")
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
