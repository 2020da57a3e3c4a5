// SPDX-License-Identifier: MIT
/// One HTML file about a run that needs nothing else.
#pragma once

#include "view/picture.hpp"
#include "view/run_folder.hpp"

namespace tribo {

/// A picture for the report.
struct ReportPicture {
  double time;
  std::string png;  ///< the file's bytes
};

/// The page: pictures, histories, energy ledger, contact forces, where the time went, where the run comes from.
std::string report(const RunFolder& run, const std::vector<ReportPicture>& pictures);

/// Contact forces, histories and energies as charts: the part of the page that changes while a run goes on.
std::string report_charts(const RunFolder& run);

}  // namespace tribo
