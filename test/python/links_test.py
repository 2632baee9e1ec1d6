#!/usr/bin/python3
"""Every link of the documents leads somewhere: to a file of the tree, and to a heading in it. Every document is
listed in docs/README.md."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCED = re.compile(r"(?ms)^```.*?^```$|^    .*?$|`[^`\n]*`")
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def links(text):
    """Targets, those in code left out."""
    return LINK.findall(FENCED.sub(lambda code: "`" if code[0][0] == "`" and "\n" not in code[0] else "", text))


def anchors(text):
    """As GitHub makes them: lower case, spaces to hyphens, other signs away; a second one gets a number."""
    found = []
    for heading in re.findall(r"(?m)^#{1,6} +(.*?) *$", re.sub(r"(?ms)^```.*?^```$", "", text)):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        found.append(name if name not in found else f"{name}-{found.count(name)}")
    return found


def fault(document, target):
    """Why a link leads nowhere, or None."""
    if re.match(r"https?://|mailto:", target):
        return None
    place, _, anchor = target.partition("#")
    path = (document.parent / place).resolve() if place else document
    if not path.exists():
        return f"{document.relative_to(ROOT)}: no file {target}"
    if anchor and anchor not in anchors(path.read_text(encoding="utf-8")):
        return f"{document.relative_to(ROOT)}: no heading {target}"
    return None


class Links(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        count = 0
        for document in DOCUMENTS:
            for target in links(document.read_text(encoding="utf-8")):
                count += 1
                self.assertIsNone(fault(document, target))
        self.assertGreater(count, 100)

    def test_wrong_links_are_found(self):
        readme = ROOT / "README.md"
        self.assertIn("no file", fault(readme, "docs/nobody.md"))
        self.assertIn("no heading", fault(readme, "docs/topics.md#nobody"))
        self.assertIsNone(fault(readme, "docs/topics.md#several-insects-on-one-master"))
        self.assertEqual(links("[a](b.md) `[c](d.md)`\n\n    [e](f.md)\n```\n[g](h.md)\n```\n![i](j.png)"),
                         ["b.md", "j.png"])

    def test_every_document_is_listed(self):
        index = {(ROOT / "docs" / target).resolve() for target in
                 links((ROOT / "docs/README.md").read_text(encoding="utf-8"))}
        for document in (ROOT / "docs").glob("*.md"):
            if document.name != "README.md":
                self.assertIn(document, index, "not listed in docs/README.md")


if __name__ == "__main__":
    unittest.main()
