"""Writes mutations into sources so that each is behind a switch: what mutants.hpp reads."""

import re

from mutate import blanked

LIVE = 1 << 16  # mutants.hpp: kLive
BINARY = {"+", "-", "*", "/", "<", "<=", ">", ">=", "==", "!="}
OPENING, CLOSING = "([{", ")]}"
BLOCK = re.compile(r"(\)|\b(const|noexcept|else|do|try|override|final)|->\s*[\w:<>*&, ]+)\s*$")
HEAD = re.compile(r"\b(struct|class|namespace|enum|union)\b[^;{}()]*$")
CONSTANT = re.compile(r"((?:static|inline)\s+)?constexpr\s+[\w:<>,\s*&]+?\b\w+\s*(\[[^\]]*\]\s*)*(=|\{)")

# How far a mutation gives in when it does not compile: a switch that makes constants variable; one that leaves alone what the compiler
# needs to know; none.
VARIABLE, CONSTANT_KEPT, NONE = 0, 1, 2


def statement_start(text, at):
    """Where the statement begins in which `at` stands; text is blanked."""
    depth, i = 0, at - 1
    while i >= 0:
        c = text[i]
        if c == "}" and depth == 0:
            after = text[i + 1 :].lstrip()[:1]
            if after not in ",)}":
                return i + 1
            depth += 1
        elif c in CLOSING:
            depth += 1
        elif c == "{" and depth == 0:
            before = text[:i].rstrip()
            if BLOCK.search(before[-60:]) or HEAD.search(before[-160:]) or before[-1:] in ";:":
                return i + 1
        elif c in OPENING:
            depth = max(0, depth - 1)
        elif c == ";" and depth == 0:
            return i + 1
        i -= 1
    return 0


def enclosing_head(text, at):
    """The words in front of the brace in which `at` stands."""
    depth = 0
    for i in range(at - 1, -1, -1):
        if text[i] == "}":
            depth += 1
        elif text[i] == "{":
            if depth == 0:
                return text[max(0, i - 200) : i]
            depth -= 1
    return ""


def of_variable(text, start, path):
    """What the word constexpr of this statement becomes, as (from, to, words); None where it declares no variable."""
    match = CONSTANT.match(text, len(text[:start]) + len(text[start:]) - len(text[start:].lstrip()))
    if not match:
        return None
    word = text.index("constexpr", match.start())
    before = text[match.start() : word].strip()
    if before == "static" and HEAD.search(enclosing_head(text, match.start()).rstrip() + " "):
        return word, word + 9, "inline const"
    return word, word + 9, "const"


def left_end(text, at, stop_at_or):
    """Where the left operand of a logical operator at `at` begins."""
    depth, i = 0, at - 1
    while i >= 0:
        c, two = text[i], text[i - 1 : i + 1]
        if c in CLOSING:
            if c == "}" and depth == 0 and text[i + 1 : at].strip()[:1] not in ".":
                return i + 1
            depth += 1
        elif c in OPENING:
            if depth == 0:
                return i + 1
            depth -= 1
        elif depth == 0:
            if c in ",;?":
                return i + 1
            if c == ":" and two != "::" and text[i : i + 2] != "::":
                return i + 1
            if c == "=" and text[i - 1] not in "=!<>" and text[i + 1] != "=":
                return i + 1
            if stop_at_or and two == "||":
                return i + 1
            if text[max(0, i - 5) : i + 1] == "return" and not text[i + 1 : i + 2].isalnum():
                return i + 1
        i -= 1
    return 0


def right_end(text, at, stop_at_and):
    """Where the right operand that begins at `at` ends."""
    depth, i = 0, at
    while i < len(text):
        c, two = text[i], text[i : i + 2]
        if c in OPENING:
            depth += 1
        elif c in CLOSING:
            if depth == 0:
                return i
            depth -= 1
        elif depth == 0:
            if c in ",;?" or two == "||" or (stop_at_and and two == "&&"):
                return i
            if two == "::":
                i += 1
            elif c == ":":
                return i
        i += 1
    return len(text)


def with_logical(text):
    """Every marked && and || as two ways behind a switch."""
    mark = re.compile(r"/\*MUTANT (\d+)\*/(&&|\|\|)")
    while match := mark.search(text):
        plain = blanked(text[: match.start()]) + " " * (match.end() - match.start()) + blanked(text[match.end() :])
        operator, id = match.group(2), match.group(1)
        begin = left_end(plain, match.start(), operator == "&&")
        end = right_end(plain, match.end(), operator == "&&")
        left, right = text[begin : match.start()].strip(), text[match.end() : end].strip()
        other = "||" if operator == "&&" else "&&"
        text = text[:begin] + f" (mutants::logical<{id}>() ? (({left}) {other} ({right})) : ({left} {operator} {right}))" + text[end:]
    return text


def switched(path, text, mutations, header):
    """The source with these mutations in it: (id, line, column, before, after, level) each. Ids of those that cannot be, beside it."""
    plain = blanked(text)
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    edits, relaxed, cannot = [], {}, []
    for id, line, column, before, after, level in mutations:
        at = starts[line - 1] + column
        end = at + len(before)
        if level == NONE or text[at - 1 : at] == "'" or text[end : end + 1] == "'":
            cannot.append(id)
            continue
        tag = id + (LIVE if level == VARIABLE else 0)
        if level == VARIABLE:
            found = of_variable(plain, statement_start(plain, at), path)
            if found:
                relaxed[found[0]] = found
        if before in BINARY and after == "":
            edits.append((at, end, f"mutants::at<{tag}>->*"))
        elif before in BINARY:
            edits.append((at, end, f"{before} mutants::at<{tag}> {before}"))
        elif before in ("&&", "||"):
            edits.append((at, end, f"/*MUTANT {tag}*/{before}"))
        elif before in ("+=", "-="):
            edits.append((at, end, f"{before} mutants::at<{tag}> ="))
        elif before == "*=":
            edits.append((at, end, f"{before} mutants::product_at<{tag}> ="))
        elif before[:1].isdigit() or before[:1] == ".":
            edits.append((at, end, f"mutants::number<{tag}>({before}, {after})"))
        else:
            cannot.append(id)
    if not edits:
        return text, cannot
    for at, end, words in sorted([*edits, *relaxed.values()], reverse=True):
        text = text[:at] + words + text[end:]
    text = with_logical(text)
    include = f'#include "{header}"\n'
    if "#pragma once" in text:
        text = text.replace("#pragma once\n", "#pragma once\n" + include, 1)
    else:
        text = include + text
    return text, cannot
