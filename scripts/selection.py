"""What a run of scripts/verify looks at: what changed since the commit named in scripts/lint-base, and a share of the rest
that changes with each commit, so that a few commits see everything."""
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]


def git(*arguments):
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.split() if done.returncode == 0 else None


def changed_files():
    """Relative paths, new ones too; None when the base is unknown here."""
    base = (ROOT / "scripts" / "lint-base").read_text().split()[0]
    changed = git("diff", "--name-only", base)
    new = git("ls-files", "--others", "--exclude-standard")
    return None if changed is None or new is None else set(changed + new)


def share(names, parts):
    """One of so many parts of the names, another with each commit."""
    count = int((git("rev-list", "--count", "HEAD") or ["0"])[0])
    return {name for index, name in enumerate(sorted(names)) if index % parts == count % parts}
