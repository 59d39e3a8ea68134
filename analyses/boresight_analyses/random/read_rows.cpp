#include "boresight_analyses/random/read_rows.hpp"

#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/csv_column.hpp"

namespace boresight {

const KeyTable& rows_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "distribution.rows",
      .says = "The rows of a CSV file, each as probable as any other; the parameters take their values from one row.",
      .keys = {text("file").says("The CSV file; a relative name is taken from the study file's folder."),
               texts("columns")
                   .usually("the parameters' paths")
                   .says("The columns' names, as in the file's first line, one for each parameter."),
               texts("units").usually("SI").says("Units of the columns, such as [\"mm\", \"1\"].")}};
  return table_of_keys;
}

SampleRows read_rows(Cursor& rows, const std::vector<std::string>& names, const std::vector<std::string>& si_units) {
  rows.only(rows_keys());
  const std::string file = beside(rows.origin().file, rows.text("file"));
  const std::string as_many = std::to_string(names.size()) + " of them, one for each parameter";
  std::vector<std::string> columns = names, units = si_units;
  if (rows.has("columns")) columns = rows.texts("columns");
  rows.require(columns.size() == names.size(), "columns", as_many);
  if (rows.has("units")) units = rows.texts("units");
  rows.require(units.size() == names.size(), "units", as_many);
  MatX values;
  for (std::size_t k = 0; k < names.size(); ++k) {
    double scale = 1.0;
    try {
      scale = scale_of_unit(units[k], unit_called(si_units[k]));
    } catch (const ValueFault& fault) {
      throw InputError(rows.origin("units"), rows.path("units"), fault.found, fault.expected, fault.nearest);
    }
    try {
      const std::vector<double> column = read_csv_column(file, columns[k]);
      if (k == 0) values.resize(static_cast<Eigen::Index>(column.size()), static_cast<Eigen::Index>(names.size()));
      values.col(static_cast<Eigen::Index>(k)) =
          scale * Eigen::Map<const VecX>(column.data(), static_cast<Eigen::Index>(column.size()));
    } catch (const ColumnFault& fault) {
      const char* key = fault.about_the_file || !rows.has("columns") ? "file" : "columns";
      throw InputError(rows.origin(key), rows.path(key), fault.found, fault.expected, fault.nearest);
    }
  }
  rows.finish();
  return SampleRows(values);
}

}  // namespace boresight
