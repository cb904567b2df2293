//! Parts of a documentation page.

/// A fenced block.
pub struct Block<'a> {
    /// Language after the fence.
    pub language: &'a str,
    /// File name in the last line of text before the block.
    pub file: Option<&'a str>,
    /// Lines of the block.
    pub content: String,
}

/// Returns the fenced blocks of a page.
pub fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut found = Vec::new();
    let mut file = None;
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        let named = line
            .strip_prefix('`')
            .and_then(|rest| rest.strip_suffix("`:"));
        file = named.or(file);
        if let Some(language) = line.strip_prefix("```") {
            let content = lines.by_ref().take_while(|line| *line != "```");
            let content = content.map(|line| format!("{line}\n")).collect();
            found.push(Block {
                language,
                file: file.take(),
                content,
            });
        }
    }
    found
}
