// SPDX-License-Identifier: MIT
#include "view/report.hpp"

#include "base/text.hpp"
#include "view/chart.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace tribo {
namespace {

// By which a page is known as a report.
const std::string signature = "<meta name='generator' content='tribo report'>";

using OrderedJson = nlohmann::ordered_json;

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8U | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) out += k + j <= bytes.size() ? digits[group >> (18U - 6U * j) & 63U] : '=';
  }
  return out;
}

constexpr const char* style = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1360px;margin:2em auto;padding:0 1.2em}
h1{font-size:1.6em;margin-bottom:.1em}h2{margin-top:1.8em;border-bottom:1px solid #ddd}
.charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(520px,1fr));gap:1.2em}
figure{margin:0}figure img{width:100%;border:1px solid #ddd}
svg{width:100%;font:11px system-ui,sans-serif;fill:#333}svg .title{font-weight:600;font-size:14px}
svg .grid{stroke:#e4e4e4}svg .frame{fill:none;stroke:#888}svg path{fill:none;stroke-width:1.6}
table{border-collapse:collapse}td,th{padding:.2em .9em .2em 0;text-align:left;vertical-align:top}
td.number{text-align:right;font-variant-numeric:tabular-nums}
.bar{background:#0072b2;height:.8em;display:inline-block}
.bad{color:#b00020;font-weight:600}.quiet{color:#666}
)";

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th>" + escaped(name) + "</th><td>" + escaped(value) + "</td></tr>\n";
}

std::string plain(const OrderedJson& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

std::string time_name_of(const Legend& legend) { return with_unit("time", legend.time); }

// Columns of one quantity, `velx:Left` and `velx:Right`, in one chart.
std::string history_charts(const ResultTable& table, const Legend& legend, bool contact) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<Curve>> groups;
  std::map<std::string, std::string> unit;
  for (std::size_t k = 1; k < table.names.size(); ++k) {
    const auto colon = table.names[k].find(':');
    const std::string quantity = table.names[k].substr(0, colon);
    const bool is_contact = quantity.rfind("contact", 0) == 0 || quantity.rfind("Contact", 0) == 0 ||
                            quantity == "Friction Work" || quantity == "Impact Work" || quantity == "Interface Energy";
    if (is_contact != contact) continue;
    if (!groups.count(quantity)) order.push_back(quantity);
    unit[quantity] = legend.unit_of(table.names[k]);
    groups[quantity].push_back(
        {colon == std::string::npos ? quantity : table.names[k].substr(colon + 1), table.columns[k]});
  }
  std::string out;
  for (const auto& quantity : order)
    out += chart(with_unit(quantity, unit[quantity]), time_name_of(legend), table.columns[0], groups[quantity]);
  return out.empty() ? out : "<div class='charts'>" + out + "</div>\n";
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  return most;
}

std::string energy_section(const ResultTable& table, const Legend& legend) {
  const std::string energy = legend.unit_of("kinetic");
  std::vector<Curve> contents;
  double most = 0.0;
  const std::vector<double>* residual = table.column("residual");
  for (std::size_t k = 1; k < table.names.size(); ++k) {
    const std::string& name = table.names[k];
    if (name == "residual" || name.rfind("momentum", 0) == 0 || name.rfind("impulse", 0) == 0) continue;
    if (const double size = largest(table.columns[k]); size > 0)
      contents.push_back({name, table.columns[k]}), most = std::max(most, size);
  }
  std::string out =
      "<div class='charts'>" + chart(with_unit("energies", energy), time_name_of(legend), table.columns[0], contents);
  if (residual)
    out += chart(with_unit("residual of the energy ledger", energy), time_name_of(legend), table.columns[0],
                 {{"residual", *residual}});
  std::vector<Curve> momenta;
  for (const char* name : {"momentum_x", "momentum_y", "momentum_z"})
    if (const auto* column = table.column(name); column && largest(*column) > 0) momenta.push_back({name, *column});
  if (!momenta.empty())
    out += chart(with_unit("momentum", legend.unit_of("momentum_x")), time_name_of(legend), table.columns[0], momenta);
  out += "</div>\n<table><tr><th>at the end</th><th></th></tr>\n";
  for (const auto& c : contents)
    out += "<tr><td>" + escaped(c.name) + "</td><td class='number'>" + short_number(c.values.back()) + "</td></tr>\n";
  if (residual && !residual->empty() && most > 0)
    out += "<tr><td>residual</td><td class='number'>" + short_number(residual->back()) + " (" +
           short_number(100 * residual->back() / most) + " % of the largest)</td></tr>\n";
  return out + "</table>\n";
}

std::string timing_section(const OrderedJson& record) {
  if (!record.contains("seconds_of")) return {};
  std::vector<std::pair<double, std::string>> parts;
  double sum = 0.0;
  for (const auto& [name, seconds] : record["seconds_of"].items()) {
    parts.emplace_back(seconds.get<double>(), name);
    sum += parts.back().first;
  }
  std::sort(parts.rbegin(), parts.rend());
  std::string out = "<table>\n";
  for (const auto& [seconds, name] : parts) {
    if (!(seconds > 0)) continue;
    out += "<tr><td>" + escaped(name) + "</td><td class='number'>" + short_number(seconds) +
           " s</td><td><span class='bar' style='width:" + short_number(std::max(1.0, 300 * seconds / sum)) +
           "px'></span> " + short_number(100 * seconds / sum) + " %</td></tr>\n";
  }
  return out + "</table>\n";
}

std::string charts_of(const RunFolder& run, const Legend& legend) {
  std::string out;
  const ResultTable history = run.history();
  if (const std::string charts = history_charts(history, legend, true); !charts.empty())
    out += "<h2>Contact</h2>\n" + charts;
  if (const std::string charts = history_charts(history, legend, false); !charts.empty())
    out += "<h2>Histories</h2>\n" + charts;
  if (const ResultTable energy = run.energy(); energy.rows() > 0)
    out += "<h2>Energy ledger</h2>\n" + energy_section(energy, legend);
  return out;
}

std::string report_of(const RunFolder& run, const OrderedJson& record, const std::vector<ReportPicture>& pictures) {
  const auto text = [&](const char* key) { return record.contains(key) ? plain(record[key]) : std::string(); };
  const OrderedJson model = record.contains("model") ? record["model"] : OrderedJson::object();
  const std::string title = model.contains("title") ? plain(model["title"]) : "";
  const std::string name = title.empty() ? run.path().filename().string() : title.substr(0, title.find('\n'));

  std::string out = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>" + signature + "<title>" +
                    escaped(name) + "</title>\n<style>" + style + "</style></head><body>\n<h1>" + escaped(name) +
                    "</h1>\n";
  const std::string status = text("status");
  out += "<p class='" + std::string(status == "failed" ? "bad" : "quiet") + "'>" + escaped(status) +
         (text("reason").empty() ? "" : ": " + escaped(text("reason"))) + "; time " + escaped(text("time")) + " of " +
         escaped(text("end_time")) + ", " + escaped(text("step")) + " steps</p>\n";
  if (model.contains("contact impulses"))
    out += "<p class='quiet'>contact impulses: " + escaped(plain(model["contact impulses"])) + "</p>\n";
  for (const auto& [key, kind] : {std::pair("to_look_at", "bad"), std::pair("figures", "quiet")})
    if (record.contains(key))
      for (const auto& line : record[key])
        out += "<p class='" + std::string(kind) + "'>" + escaped(plain(line)) + "</p>\n";
  if (!pictures.empty()) {
    out += "<h2>Particles</h2>\n<div class='charts'>";
    for (const auto& p : pictures)
      out += "<figure><img alt='particles at time " + short_number(p.time) + "' src='data:image/png;base64," +
             base64(p.png) + "'></figure>\n";
    out += "</div>\n";
  }
  out += charts_of(run, run.legend());
  if (const std::string timing = timing_section(record); !timing.empty())
    out += "<h2>Where the time went</h2>\n" + timing;
  out += "<h2>Where it comes from</h2>\n<table>\n";
  for (const auto& [key, value] : record.items())
    if (!value.is_structured()) out += row(key, plain(value));
  for (const auto& [key, value] : model.items()) out += row(key, plain(value));
  return out + "</table>\n</body></html>\n";
}

}  // namespace

bool is_report(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return false;  // a pipe would wait
  std::ifstream in(file, std::ios::binary);
  std::string begin(200, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.find(signature) != std::string::npos;
}

std::string report_charts(const RunFolder& run) { return charts_of(run, run.legend()); }

std::string report(const RunFolder& run, const std::vector<ReportPicture>& pictures) {
  try {
    return report_of(run, OrderedJson::parse(run.provenance()), pictures);
  } catch (const OrderedJson::exception& error) {
    throw damaged_record(run.path(), error.what());
  }
}

}  // namespace tribo
