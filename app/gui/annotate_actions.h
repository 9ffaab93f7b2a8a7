// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

class ActionTable;
class MainWindow;

/// Painting: mode, tools, labels, undo and redo, carrying.
void add_annotate_actions(ActionTable& table, MainWindow& window);

/// Saving, exporting and importing what is painted; they belong to the menu of files.
void add_scribble_file_actions(ActionTable& table, MainWindow& window);

/// Puts the buttons of these commands into the Annotate tab, and keeps all of them enabled, checked
/// and named as the document is.
void follow_document(ActionTable& table, MainWindow& window);

}  // namespace episcope
