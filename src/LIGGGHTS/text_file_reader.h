/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Reads rows of numbers as LAMMPS' classes of these names do: a number sign starts a comment, empty rows are left out.

#ifndef LMP_TEXT_FILE_READER_H
#define LMP_TEXT_FILE_READER_H

#include "format_liggghts.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace LAMMPS_NS {

struct TokenizerException : std::runtime_error {
  TokenizerException(const std::string &what, const std::string &text) : std::runtime_error(what + ": " + text) {}
};

class TextFileReader {
 public:
  TextFileReader(const std::string &name, const std::string &type) : file(name)
  {
    if (!file) throw std::runtime_error("cannot open " + type + " file " + name);
  }
  char *next_line()
  {
    while (std::getline(file, line)) {
      line.resize(std::min(line.find('#'), line.size()));
      if (line.find_first_not_of(" \t\r") != std::string::npos) return line.data();
    }
    return nullptr;
  }

 private:
  std::ifstream file;
  std::string line;
};

class ValueTokenizer {
 public:
  explicit ValueTokenizer(const std::string &text)
  {
    std::istringstream in(text);
    for (std::string word; in >> word;) words.push_back(word);
  }
  std::size_t count() const { return words.size(); }
  double next_double()
  {
    const std::string &word = words.at(next++);
    if (!utils::is_double(word)) throw TokenizerException("Not a valid floating-point number", word);
    return std::strtod(word.c_str(), nullptr);
  }

 private:
  std::vector<std::string> words;
  std::size_t next = 0;
};

}    // namespace LAMMPS_NS
#endif
