"""The paper's Section IV and the gap tables: campaigns, their reports and their pictures."""
