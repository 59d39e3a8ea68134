#include "terminal/terminal.hpp"

#include <gmock/gmock.h>

#include <cstdio>
#include <vector>

#include "results/tables.hpp"
#include "terminal/columns.hpp"

namespace boresight::app {
namespace terminal_test {

TEST(Terminal, ShowsControlCharactersAsTheirNumbers) {
  EXPECT_EQ(printable("\x1b[2J\x07 a\x7f"), "\\x1b[2J\\x07 a\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m");  // the control sequence introducer of 8 bits
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb");  // right-to-left override
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");  // no UTF-8
  EXPECT_EQ(printable("cut \xe2\x80"), "cut \\xe2\\x80");
  EXPECT_EQ(printable("0.231 mm, 22 µm ± 3 m/s²\n\tnext"), "0.231 mm, 22 µm ± 3 m/s²\n\tnext");
}

TEST(Columns, AreThoseThatALetterTakes) {
  EXPECT_EQ(columns_in("Träger φ1"), 9u);
  EXPECT_EQ(columns_in("軸受"), 4u);
  EXPECT_EQ(columns_in("a\u0308b"), 2u);  // an accent behind its letter
  EXPECT_EQ(padded("Träger", 8), "Träger  ");
  EXPECT_EQ(padded("Träger", 3), "Träger");
  EXPECT_EQ(first_columns("µµµµ", 3), "µµµ");
  EXPECT_EQ(first_columns("軸受", 3), "軸");
  const std::vector<std::string> names = {"Azimut", "Trägerφ"};
  EXPECT_EQ(widest_of(names, [](const std::string& name) { return name; }), 7u);
}

TEST(Csv, ATextIsNoFormulaAndANumberStaysOne) {
  for (const char* text : {"=1+1", "+cmd", "-2+3", "@SUM(A1)", "\tx", "\rx"})
    EXPECT_EQ(csv_field(text).find('\''), csv_field(text)[0] == '"' ? 1u : 0u) << text;
  EXPECT_EQ(csv_field("=HYPERLINK(\"x\",1)"), "\"'=HYPERLINK(\"\"x\"\",1)\"");
  for (const char* text : {"-1.5", "+3e-4", "clearance.F1.radial", "radial-", ""}) EXPECT_EQ(csv_field(text), text);
}

TEST(ShellWord, IsTheSameWordForAShell) {
  for (const std::string word : {"study.toml", "a b", "it's", "$(touch x)", "`x`", "a;b", "--set", "x=1 mm", "", "*",
                                 "\"q\"", "tab\there", "~/x", "!x"}) {
    std::FILE* shell = ::popen(("printf %s " + shell_word(word)).c_str(), "r");
    std::string said;
    for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) said += static_cast<char>(c);
    ::pclose(shell);
    EXPECT_EQ(said, word);
  }
  EXPECT_EQ(shell_word("clearance.F1.radial=0.2mm"), "clearance.F1.radial=0.2mm");
}

}  // namespace terminal_test
}  // namespace boresight::app
