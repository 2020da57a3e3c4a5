// SPDX-License-Identifier: MIT
/// A self-contained HTML report of a run.
#pragma once

#include "view/picture.hpp"
#include "view/run_folder.hpp"

namespace tribo {

/// A picture for the report.
struct ReportPicture {
  double time;
  std::string png;  ///< the file's bytes
};

/// The page: pictures, histories, energy ledger, contact forces, computing time, provenance.
std::string report(const RunFolder& run, const std::vector<ReportPicture>& pictures);

/// Whether a file is such a page.
bool is_report(const std::filesystem::path& file);

/// Contact forces, histories and energies as charts: the part of the page that changes during a run.
std::string report_charts(const RunFolder& run);

}  // namespace tribo
