#include "core/messaging/channels.h"
#include "core/process/graph.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace goalmouth {
namespace {

/// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string dot_text(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

/// What the process reads or writes, under the names of this graph, the common STATUS left out.
std::vector<std::string> names(const GraphProcess& process, const std::vector<ChannelUse>& uses,
                               const std::set<std::string>& published = {}) {
    std::vector<std::string> result;
    for (const auto& use : uses) {
        if (use.channel == channels::status) continue;
        const std::string channel = process.channel(use.channel);
        const bool idle = use.optional && !published.contains(channel);
        result.push_back(idle ? "(" + channel + ")" : channel);
    }
    return result;
}

std::set<std::string> published_channels(const Graph& graph) {
    std::set<std::string> published(graph.external.begin(), graph.external.end());
    for (const auto& process : graph.processes) {
        for (const auto& use : process.description.info.publishes)
            published.insert(process.channel(use.channel));
    }
    return published;
}

/// The settings that hold, each key once.
std::vector<std::string> changed_parameters(const GraphProcess& process) {
    std::map<std::string, std::string> last;
    for (const auto& setting : process.settings) last[setting.key] = setting.value;
    std::vector<std::string> lines;
    for (const auto& [key, value] : last) lines.push_back(key + " = " + value);
    return lines;
}

using Cells = std::vector<std::vector<std::string>>;  // one list of lines for each column

void print_row(std::ostringstream& out, const Cells& row, const std::vector<std::size_t>& widths) {
    std::size_t height = 1;
    for (const auto& cell : row) height = std::max(height, cell.size());
    for (std::size_t line = 0; line < height; ++line) {
        std::string text;
        for (std::size_t column = 0; column < row.size(); ++column) {
            const std::string cell = line < row[column].size() ? row[column][line] : "";
            text += cell + std::string(widths[column] - width_of(cell) + 2, ' ');
        }
        out << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
    }
}

}  // namespace

std::string graph_as_table(const Graph& graph) {
    const auto published = published_channels(graph);
    std::vector<Cells> rows = {
        {{"PROCESS"}, {"EXECUTABLE"}, {"SUBSCRIBES"}, {"PUBLISHES"}, {"PARAMETERS SET HERE"}}};
    for (const auto& process : graph.processes) {
        rows.push_back({{process.name},
                        {process.executable},
                        names(process, process.description.info.subscribes, published),
                        names(process, process.description.info.publishes),
                        changed_parameters(process)});
    }
    std::vector<std::size_t> widths(rows[0].size(), 0);
    for (const auto& row : rows) {
        for (std::size_t column = 0; column < row.size(); ++column) {
            for (const auto& line : row[column]) widths[column] = std::max(widths[column], width_of(line));
        }
    }
    std::ostringstream out;
    out << "graph " << graph.name << " (" << graph.file.string() << "), seed " << graph.seed << ", "
        << lcm_url_of(graph) << "\n\n";
    for (const auto& row : rows) print_row(out, row, widths);
    if (!graph.external.empty()) {
        out << "\nfrom outside the graph:";
        for (const auto& channel : graph.external) out << ' ' << channel;
        out << '\n';
    }
    out << "\nEvery process publishes STATUS. (IN BRACKETS): read where it comes, and nobody publishes it "
           "here.\n";
    return out.str();
}

std::string graph_as_dot(const Graph& graph) {
    std::ostringstream out;
    out << "digraph " << dot_text(graph.name) << " {\n"
        << "  rankdir=LR;\n  fontname=\"sans-serif\";\n"
        << "  node [shape=box, style=\"rounded,filled\", fillcolor=\"#eef4ea\", color=\"#4a7a3a\", "
           "fontname=\"sans-serif\"];\n"
        << "  edge [color=\"#555555\", fontname=\"sans-serif\", fontsize=10];\n";
    std::map<std::string, std::string> source;  // channel → node
    for (const auto& process : graph.processes) {
        const bool same = process.name == process.executable;
        const std::string label = process.name + (same ? "" : "\n" + process.executable);
        out << "  " << dot_text(process.name) << " [label=" << dot_text(label)
            << ", tooltip=" << dot_text(process.description.info.summary) << "];\n";
        for (const auto& channel : names(process, process.description.info.publishes))
            source[channel] = process.name;
    }
    for (const auto& channel : graph.external) {
        source[channel] = "outside:" + channel;
        out << "  " << dot_text(source[channel]) << " [label=\"outside\", style=dashed, fillcolor=white];\n";
    }
    std::set<std::string> read;
    for (const auto& process : graph.processes) {
        for (const auto& use : process.description.info.subscribes) {
            const std::string channel = process.channel(use.channel);
            if (use.channel == channels::status || !source.contains(channel)) continue;
            read.insert(channel);
            out << "  " << dot_text(source[channel]) << " -> " << dot_text(process.name)
                << " [label=" << dot_text(channel) << (use.optional ? ", style=dashed" : "") << "];\n";
        }
    }
    for (const auto& [channel, node] : source) {
        if (read.contains(channel)) continue;
        const std::string end = "end:" + channel;
        out << "  " << dot_text(end) << " [shape=plaintext, style=\"\", label=\"\", width=0.1];\n"
            << "  " << dot_text(node) << " -> " << dot_text(end) << " [label=" << dot_text(channel) << "];\n";
    }
    out << "}\n";
    return out.str();
}

}  // namespace goalmouth
