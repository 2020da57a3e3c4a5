# SPDX-License-Identifier: MIT
"""Equations of the site of the manual: a hook of MkDocs that bundles KaTeX, so that they are typeset without a network."""
import pathlib
import shutil

KATEX = pathlib.Path("/usr/share/javascript/katex")  # Debian's package libjs-katex

LOADER = """
<link rel="stylesheet" href="{root}katex/katex.min.css">
<script src="{root}katex/katex.min.js"></script>
<script>
for (const element of document.querySelectorAll(".arithmatex")) {{
  const text = element.textContent.trim();
  katex.render(text.slice(2, -2), element, {{displayMode: text.startsWith("\\\\["), throwOnError: false}});
}}
</script>
"""


def on_page_content(html, page, config, files):
    """Adds the typesetting to the pages that have equations."""
    if 'class="arithmatex"' not in html:
        return html
    return html + LOADER.format(root="../" * page.file.dest_path.count("/"))


def on_post_build(config):
    """Copies KaTeX with its fonts into the site."""
    target = pathlib.Path(config["site_dir"]) / "katex"
    shutil.copytree(KATEX / "fonts", target / "fonts", dirs_exist_ok=True)
    for name in ("katex.min.js", "katex.min.css"):
        shutil.copy(KATEX / name, target / name)
