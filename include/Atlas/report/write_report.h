// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_WRITE_REPORT_H
#define ATLAS_REPORT_WRITE_REPORT_H

#include <Atlas/image/Image.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/soup/Polygon_soup.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace Atlas {

/// JSON objects that keep their keys in the order in which they are written. To use one, include
/// `nlohmann/json.hpp`.
using Json = nlohmann::ordered_json;

Json to_json(const Distortion& distortion);

Json to_json(const Atlas_certificate& certificate);

/// What was done to a chart.
Json to_json(const Flattening_record& record);

/// \brief The report as JSON. Faces and charts count from 0, in the order of the input; numbers that are not
/// finite are null.
Json to_json(const Atlas_report& report);

/// \brief The text of a JSON file. Bytes of file names that are no UTF-8 are replaced.
std::string json_text(const Json& json);

/// \brief Writes the report as a JSON file, whole or not at all. \throw IO_error
void write_report(const std::filesystem::path& path, const Atlas_report& report);

/// The pictures that an HTML report shows.
struct Report_pictures
{
  Image page;    ///< the charts in colours
  Image stretch; ///< the page coloured by stretch, without scale
  Image view;    ///< the model from several sides
};

/// \brief A report as one HTML page that needs nothing else: pictures, figures, histograms (as figure 9 of
/// Levy et al. 2002), and the model to be turned (WebGL 2, works offline). A chart that one points at is
/// shown on the model and on the page; the charts that are stretched most are listed, and a click shows the
/// spot. \param soup   with the coordinates of the atlas \param title  shown on top
std::string html_report(const Polygon_soup& soup, const Atlas_report& report, const Report_pictures& pictures,
                        const std::string& title);

/// \brief Writes the page, whole or not at all. \throw IO_error
void write_html_report(const std::filesystem::path& path, const Polygon_soup& soup,
                       const Atlas_report& report, const Report_pictures& pictures, const std::string& title);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/report/internal/write_html_report_impl.h>
#include <Atlas/report/internal/write_report_impl.h>
#endif

#endif
